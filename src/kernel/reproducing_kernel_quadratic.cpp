// SPDX-License-Identifier: BSD-3-Clause
// Shape functions of the quadratic basis.
#include "kernel/reproducing_kernel_sums.hpp"

namespace meniscus {

template class ReproducingKernel<2, 2>;
template class ReproducingKernel<3, 2>;

}  // namespace meniscus
