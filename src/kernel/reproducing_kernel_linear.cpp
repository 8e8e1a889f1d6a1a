// SPDX-License-Identifier: BSD-3-Clause
// Shape functions of the linear basis.
#include "kernel/reproducing_kernel_sums.hpp"

namespace meniscus {

template class ReproducingKernel<2, 1>;
template class ReproducingKernel<3, 1>;

}  // namespace meniscus
