// SPDX-License-Identifier: BSD-3-Clause
// The group /VTKHDF: the frames as a temporal PolyData of vertices. Field data are virtual datasets
// over /steps/<k>/<field> that grow by themselves; only the small index arrays are written.
// Source: VTK File Formats, "VTKHDF File Format" 2.x, sections PolyData and Temporal Data.
#pragma once
#include "meniscus/core/types.hpp"

#include <span>
#include <string>

#include "frame_layout.hpp"

namespace meniscus::vtkhdf {

/// `body_of_particle` is shown as the point data "body". Throws FileError.
void create(hdf5::Group& root, const FrameLayout& layout,
            std::span<const std::int64_t> body_of_particle, const std::string& time_unit);

/// Makes frame `k` the last one: all index arrays get k + 1 rows.
void append(hdf5::Group& root, const FrameLayout& layout, std::int64_t k, Real time);

/// Tells readers that there are so many frames. To be flushed apart: the arrays must be longer
/// before, and shorter after, and within one flush HDF5 has an order of its own.
void announce(hdf5::Group& root, std::int64_t frames);

/// The index arrays have no rows any more.
void clear(hdf5::Group& root, const FrameLayout& layout);

/// The layout with which create() was called.
FrameLayout layout(const hdf5::Group& root);

}  // namespace meniscus::vtkhdf
