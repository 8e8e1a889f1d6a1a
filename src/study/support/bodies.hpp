// SPDX-License-Identifier: BSD-3-Clause
// Reference bodies of surface studies.
#pragma once
#include "body/shapes/geometry.hpp"

#include <string>
#include <vector>

namespace meniscus::study {

/// The shapes that reference_body() can make; the first one is smooth, the others have edges.
template <int D>
const std::vector<std::string>& reference_shapes();
template <>
const std::vector<std::string>& reference_shapes<2>();
template <>
const std::vector<std::string>& reference_shapes<3>();

/// A ball or disk of radius 1 with n cells along an edge of the core inside n / 2 shells. Box,
/// cylinder and rectangle are for studies without curvature. Particles are in spatial order.
template <int D>
Geometry<D> reference_body(const std::string& shape, int n);

/// Throws InputError with cause and remedy if the body has edges.
template <int D>
void require_curvature(const std::string& shape, const Geometry<D>& geometry);

}  // namespace meniscus::study
