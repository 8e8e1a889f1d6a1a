// SPDX-License-Identifier: BSD-3-Clause
// Layout that all frames of a result file share.
#pragma once
#include "io/hdf5_file.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// A stored field.
struct StoredField {
  std::string name;
  int components = 1;  ///< 1, 3, 6 or 9
  std::string unit;
  friend bool operator==(const StoredField&, const StoredField&) = default;
};

struct FrameLayout {
  std::int64_t particles = 0;
  std::int64_t cells = 0;
  std::int64_t corners = 0;  ///< total number of corners of all cells
  int cell_type = 0;         ///< VTK's number of the type; 0: several types
  hdf5::Type precision = hdf5::Type::float64;
  std::vector<StoredField> fields;  ///< sorted by name
  friend bool operator==(const FrameLayout&, const FrameLayout&) = default;
};

}  // namespace meniscus
