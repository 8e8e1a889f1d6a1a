// SPDX-License-Identifier: BSD-3-Clause
// Shape functions of the cubic basis.
#include "kernel/reproducing_kernel_sums.hpp"

namespace meniscus {

template class ReproducingKernel<2, 3>;
template class ReproducingKernel<3, 3>;

}  // namespace meniscus
