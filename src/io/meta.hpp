// SPDX-License-Identifier: BSD-3-Clause
// Provenance and snapshots as HDF5 groups; used by result files and checkpoints.
#pragma once
#include "io/hdf5_file.hpp"
#include "io/provenance.hpp"
#include "state/snapshot.hpp"

#include <string>

namespace meniscus {

/// Adds the group "meta" to the root of a file.
void write_meta(hdf5::Group& root, const Provenance& provenance);

/// The input text of the group "meta". Throws FileError if its SHA-256 is not the stored one.
std::string read_input(const hdf5::Group& root);

/// The program that wrote the file, in the words of program_text().
std::string read_program(const hdf5::Group& root);

/// Adds the group "state" with its hash.
void write_state(hdf5::Group& parent, const Snapshot& state);

/// Reads the group "state". Throws FileError if its hash is not the stored one or a number is not
/// finite.
Snapshot read_state(const hdf5::Group& parent);

}  // namespace meniscus
