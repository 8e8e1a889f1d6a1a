// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer target of the readers of checkpoints and result files. The bytes are a recipe for an
// HDF5 file: names, types, extents and values. Every such file is read correctly or refused with a
// FileError.
#include "io/checkpoint.hpp"
#include "io/files.hpp"
#include "io/info.hpp"
#include "meniscus/error.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

using namespace meniscus;

namespace {

/// Returns one byte after the other; zeros at the end.
class Recipe {
 public:
  Recipe(const unsigned char* data, std::size_t size) : data_(data), size_(size) {}
  bool at_end() const { return position_ >= size_; }
  unsigned next() { return at_end() ? 0 : data_[position_++]; }
  template <class T, std::size_t N>
  const T& one_of(const T (&list)[N]) {
    return list[next() % N];
  }

 private:
  const unsigned char* data_;
  std::size_t size_, position_ = 0;
};

constexpr const char* groups[] = {"/",
                                  "/state",
                                  "/state/control",
                                  "/meta",
                                  "/steps",
                                  "/steps/0",
                                  "/steps/0/state",
                                  "/reference",
                                  "/reference/a",
                                  "/VTKHDF",
                                  "/VTKHDF/Steps",
                                  "/state/a/b/c/d/e"};
constexpr const char* names[] = {
    "velocity", "step",      "time",     "hash",        "input",        "input_sha256", "version",
    "git_hash", "git_dirty", "compiler", "flags",       "particles",    "units",        "Values",
    "position", "state",     "threads",  "started_utc", "command_line", "program"};

hid_t type_of(Recipe& recipe) {
  const hid_t numbers[] = {H5T_IEEE_F64LE, H5T_STD_I64LE, H5T_IEEE_F32LE, H5T_STD_I32LE,
                           H5T_IEEE_F64BE, H5T_STD_U8LE,  H5T_STD_REF_OBJ};
  const unsigned kind = recipe.next();
  if (kind % 2 == 0) return H5Tcopy(numbers[kind / 2 % 7]);
  const hid_t text = H5Tcopy(H5T_C_S1);
  const std::size_t sizes[] = {1, 16, 64, 4000, 1 << 20, 1 << 30, H5T_VARIABLE};
  H5Tset_size(text, recipe.one_of(sizes));
  return text;
}

hid_t space_of(Recipe& recipe) {
  const hsize_t extents[] = {0, 1, 2, 3, 9, 100, 1 << 20, hsize_t{1} << 40, (hsize_t{1} << 61) + 1};
  const unsigned rank = recipe.next() % 5;
  if (rank == 0) return H5Screate(H5S_SCALAR);
  if (rank == 4) return H5Screate(H5S_NULL);
  hsize_t size[3];
  for (hsize_t& extent : size) extent = recipe.one_of(extents);
  return H5Screate_simple(static_cast<int>(rank), size, nullptr);
}

/// True if HDF5 would hold the whole dataset in memory to write it.
bool is_bulky(hid_t type, hid_t space) {
  constexpr double most = 1 << 20;
  return static_cast<double>(H5Sget_simple_extent_npoints(space)) *
             static_cast<double>(H5Tget_size(type)) >
         most;
}

void put(hid_t group, Recipe& recipe) {
  const char* name = recipe.one_of(names);
  const unsigned what = recipe.next() % 8;
  if (what == 0) H5Ldelete(group, name, H5P_DEFAULT);
  if (what == 1) H5Lcreate_soft(recipe.one_of(groups), group, name, H5P_DEFAULT, H5P_DEFAULT);
  if (what == 2) H5Lcreate_external("other.h5", "/", group, name, H5P_DEFAULT, H5P_DEFAULT);
  if (what == 3)
    H5Lcreate_hard(group, recipe.one_of(groups), group, name, H5P_DEFAULT, H5P_DEFAULT);
  if (what < 4) return;
  const hid_t type = type_of(recipe), space = space_of(recipe);
  if (what < 6) {
    H5Adelete(group, name);
    if (!is_bulky(type, space))
      H5Aclose(H5Acreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  } else {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk[] = {1000, 1, 1};
    if (what == 7) H5Pset_chunk(properties, H5Sget_simple_extent_ndims(space), chunk);
    H5Ldelete(group, name, H5P_DEFAULT);
    H5Dclose(H5Dcreate2(group, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    H5Pclose(properties);
  }
  H5Tclose(type);
  H5Sclose(space);
}

/// Writes a good checkpoint, which is also a result file, and changes it by the recipe.
void cook(const std::filesystem::path& path, const std::string& good, Recipe recipe) {
  std::filesystem::remove(path);
  write_new_file(path, good);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t between = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(between, 1);
  for (int k = 0; k < 40 && !recipe.at_end(); ++k) {
    const char* name = recipe.one_of(groups);
    hid_t group = H5Gopen2(file, name, H5P_DEFAULT);
    if (group < 0) group = H5Gcreate2(file, name, between, H5P_DEFAULT, H5P_DEFAULT);
    if (group < 0) continue;
    put(group, recipe);
    H5Gclose(group);
  }
  H5Pclose(between);
  H5Fclose(file);
  // The checksum is corrected: it protects against damage, not against intent.
  const std::string content = read_file(path);
  Fnv1a hash;
  hash.add(std::string_view(content).substr(512));
  std::string header =
      fmt::format("meniscus checkpoint 1\nserial 1\nchecksum {:016x}\n", hash.value());
  header.resize(512, '\0');
  overwrite_beginning(path, header);
}

struct Kitchen {
  std::filesystem::path directory;
  std::string good;

  Kitchen() {
    std::string name = (std::filesystem::temp_directory_path() / "meniscus-fuzz-XXXXXX").string();
    directory = mkdtemp(name.data());
    const RunDirectory run(directory / "run", ExistingRun::refuse);
    Snapshot state;
    state.add_reals("velocity", std::vector<Real>{1, 2, 3});
    state.add_integers("step", std::vector<std::int64_t>{1});
    good = read_file(
        CheckpointWriter(run, provenance("fuzz", "dimension = 2\n")).write(1, 0.1, state));
  }
  ~Kitchen() { std::filesystem::remove_all(directory); }
};

template <class Read>
void attempt(Read read) {
  try {
    read();
  } catch (const FileError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static const Kitchen kitchen;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const auto path = kitchen.directory / "file.h5";
  cook(path, kitchen.good, {data, size});
  attempt([&] { describe_file(path); });
  attempt([&] { read_checkpoint(path); });
  attempt([&] { read_checkpoint(path, 0); });
  return 0;
}
