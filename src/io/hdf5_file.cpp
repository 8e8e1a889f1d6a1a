// SPDX-License-Identifier: BSD-3-Clause
// HDF5 files and groups, and closing them.
#include "io/hdf5_file.hpp"

#include "io/files.hpp"
#include "io/hdf5_driver.hpp"
#include "io/hdf5_types.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <hdf5.h>

#include <algorithm>

namespace meniscus::hdf5 {
namespace {

constexpr std::size_t most_members = 100'000;
constexpr int deepest = 4;

/// Disables HDF5's own printing of errors, since exceptions report them, and the loading of
/// filters, which a file could name and HDF5 would load as a library.
void be_quiet() {
  static const herr_t quiet =
      std::min(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr), H5PLset_loading_state(0));
  (void)quiet;
}

/// Reason of the last failure: the message of the innermost HDF5 function, or of the operating
/// system if that failed.
std::string reason() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* error, void* result) -> herr_t {
        if (n == 0 && error->desc) *static_cast<std::string*>(result) = error->desc;
        return 0;
      },
      &text);
  constexpr std::string_view mark = "error message = '";
  if (const auto begin = text.find(mark); begin != std::string::npos) {
    text.erase(0, begin + mark.size());
    text.erase(std::min(text.find('\''), text.size()));
  }
  return text.empty() ? "no reason given" : text;
}

/// Properties for opening files. Without HDF5's own locks, results can be read while a run writes
/// them; RunDirectory prevents a second writer. Version bounds stay at their defaults: a higher
/// bound makes the file unreadable after an interruption.
Handle access_properties() {
  be_quiet();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), "prepare HDF5");
  check(H5Pset_file_locking(access, false, true), "prepare HDF5");
  check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "prepare HDF5");
  use_ordered_writes(access);
  return access;
}

Handle open_file(const std::filesystem::path& path, unsigned mode) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw FileError(fmt::format("cannot open '{}': there is no such file", path.string()));
  if (!std::filesystem::is_regular_file(path, ignored))
    throw FileError(fmt::format("cannot open '{}': it is not a file", path.string()));
  const Handle access = access_properties();
  return {H5Fopen(path.c_str(), mode, access), fmt::format("open '{}'", path.string())};
}

}  // namespace

void check(std::int64_t status, std::string_view doing) {
  if (status < 0) throw FileError(fmt::format("cannot {}: {}", doing, reason()));
}

Handle::Handle(std::int64_t id, std::string_view doing) : id_(id) {
  check(id, doing);
}

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

Handle::~Handle() {
  if (id_ >= 0) H5Idec_ref(id_);
}

std::string Group::doing(std::string_view verb, const std::string& name) const {
  return fmt::format("{} '{}/{}'", verb, path_, name);
}

bool Group::has(const std::string& name) const {
  return H5Lexists(handle_, name.c_str(), H5P_DEFAULT) > 0;
}

bool Group::has_group(const std::string& name) const {
  if (!has(name)) return false;
  require_own(name, doing("read", name));
  const Handle object(H5Oopen(handle_, name.c_str(), H5P_DEFAULT), doing("open", name));
  return H5Iget_type(object) == H5I_GROUP;
}

std::vector<std::string> Group::names() const {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    auto& all = *static_cast<std::vector<std::string>*>(list);
    all.emplace_back(name);
    return all.size() > most_members;
  };
  check(H5Literate(handle_, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), doing("list", ""));
  require_few(names.size());
  return names;
}

void Group::for_each_array(
    const std::function<void(const std::string& name, const ArrayInfo&)>& visit) const {
  std::size_t members = 0;
  const std::function<void(const Group&, const std::string&, int)> walk =
      [&](const Group& group, const std::string& prefix, int depth) {
        if (depth > deepest)
          throw FileError(fmt::format("cannot {}: groups are nested deeper than {} levels",
                                      doing("read", prefix), deepest));
        for (const std::string& name : group.names()) {
          require_few(++members);
          if (group.has_group(name))
            walk(group.group(name), prefix + name + '/', depth + 1);
          else
            visit(prefix + name, group.info(name));
        }
      };
  walk(*this, "", 1);
}

void Group::require_few(std::size_t members) const {
  if (members > most_members)
    throw FileError(
        fmt::format("cannot {}: it has more than {} members", doing("list", ""), most_members));
}

void Group::require_own(const std::string& name, const std::string& what) const {
  for (std::size_t end = 0; end != name.npos;) {
    end = name.find('/', end + 1);
    const std::string step = name.substr(0, end);
    H5L_info_t info;
    check(H5Lget_info(handle_, step.c_str(), &info, H5P_DEFAULT), what);
    if (info.type != H5L_TYPE_HARD)
      throw FileError(fmt::format("cannot {}: '{}' is a link by name", what, step));
  }
}

Group Group::create_group(const std::string& name) {
  Handle handle(H5Gcreate2(handle_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                doing("create", name));
  return {std::move(handle), path_ + '/' + name};
}

Group Group::group(const std::string& name) const {
  require_own(name, doing("open", name));
  Handle handle(H5Gopen2(handle_, name.c_str(), H5P_DEFAULT), doing("open", name));
  return {std::move(handle), path_ + '/' + name};
}

std::uint64_t Group::file_size() const {
  return hdf5::file_size(handle_);
}

void Group::remove(const std::string& name) {
  check(H5Ldelete(handle_, name.c_str(), H5P_DEFAULT), doing("remove", name));
}

void Group::link(const std::string& name, const std::string& file, const std::string& target) {
  check(H5Lcreate_external(file.c_str(), target.c_str(), handle_, name.c_str(), H5P_DEFAULT,
                           H5P_DEFAULT),
        doing("write", name));
}

File::File(Handle handle, const std::filesystem::path& path)
    : handle_(std::move(handle)), path_(path) {}

File File::create(const std::filesystem::path& path, std::uint64_t user_block) {
  const Handle access = access_properties();
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), "prepare HDF5");
  check(H5Pset_userblock(creation, user_block), "prepare HDF5");
  // The driver allocates addresses and never uses an address twice.
  check(H5Pset_file_space_strategy(creation, H5F_FSPACE_STRATEGY_NONE, false, 1), "prepare HDF5");
  // Always creates a new file, so that an existing link of that name is replaced and not followed.
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  Handle handle(H5Fcreate(path.c_str(), H5F_ACC_EXCL, creation, access),
                fmt::format("create '{}'", path.string()));
  return {std::move(handle), path};
}

File File::open(const std::filesystem::path& path) {
  return {open_file(path, H5F_ACC_RDONLY), path};
}

File File::open_to_append(const std::filesystem::path& path) {
  return {open_file(path, H5F_ACC_RDWR), path};
}

Group File::root() const {
  Handle handle(H5Gopen2(handle_, "/", H5P_DEFAULT), fmt::format("read '{}'", path_.string()));
  return {std::move(handle), path_.string() + ":"};
}

void File::flush() {
  check(H5Fflush(handle_, H5F_SCOPE_LOCAL), fmt::format("write '{}'", path_.string()));
  if (const int error = write_error(handle_)) throw_file_error("write", path_, error);
}

void File::close() {
  flush();
  check(H5Fclose(handle_.release()), fmt::format("write '{}'", path_.string()));
}

std::uint64_t file_size(std::int64_t object) {
  constexpr const char* doing = "find the size of a file";
  const Handle file(H5Iget_file_id(object), doing);
  hsize_t size = 0;
  check(H5Fget_filesize(file, &size), doing);
  return size;
}

std::string library_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace meniscus::hdf5
