// SPDX-License-Identifier: BSD-3-Clause
// Layout that all frames of a result file share.
#pragma once
#include <string>
#include <vector>

#include "hdf5_file.hpp"

namespace meniscus {

/// A field as stored.
struct StoredField {
  std::string name;
  int components = 1;  ///< 1, 3, 6 or 9
  std::string unit;
  friend bool operator==(const StoredField&, const StoredField&) = default;
};

struct FrameLayout {
  std::int64_t particles = 0;
  std::int64_t cells = 0;
  int corners = 8;  ///< of a cell: 8 of a hexahedron, 4 of a quadrilateral
  hdf5::Type precision = hdf5::Type::float64;
  std::vector<StoredField> fields;  ///< sorted by name
  friend bool operator==(const FrameLayout&, const FrameLayout&) = default;
};

}  // namespace meniscus
