// SPDX-License-Identifier: BSD-3-Clause
// The HDF5 file driver with ordered changes (virtual file layer of HDF5 1.10 to 1.14).
#include "hdf5_driver.hpp"

#include <fcntl.h>
#include <hdf5.h>
#if H5_VERSION_GE(1, 14, 0)
#include <H5FDdevelop.h>
#endif
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "hdf5_file.hpp"

namespace meniscus::hdf5 {
namespace {

constexpr herr_t done = 0;

/// Leaves the reason where HDF5, and so the messages of hdf5::check(), look for it.
herr_t push_error(const char* what) {
  H5Epush2(H5E_DEFAULT, __FILE__, what, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_CANTOPENFILE,
           "%s, error message = '%s'", what, std::strerror(errno));
  return -1;
}

/// 0, or the number of the error.
int write_all(int file, haddr_t address, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(address));
    if (n < 0 && errno != EINTR) return errno;
    if (n < 0) continue;
    address += static_cast<haddr_t>(n);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

/// A change of what is already on the disk.
struct Change {
  H5FD_mem_t kind;
  haddr_t address;
  std::string bytes;

  haddr_t end() const { return address + bytes.size(); }
  bool covers(const Change& other) const {
    return address <= other.address && other.end() <= end();
  }
  /// Place in the order of a flush.
  std::tuple<int, int> rank() const {
    switch (kind) {
      case H5FD_MEM_DRAW:
        return {0, 0};
      case H5FD_MEM_SUPER:
        return {1, 0};
      case H5FD_MEM_LHEAP:
      case H5FD_MEM_GHEAP:
        return {2, 0};
      case H5FD_MEM_BTREE: {
        // Nodes of an index begin with "TREE", type, level (0 for leaves); then come group entries.
        if (!std::string_view(bytes).starts_with("TREE") || bytes.size() < 6) return {4, 0};
        return {3, -static_cast<unsigned char>(bytes[5])};
      }
      default:
        return {5, 0};
    }
  }
};

bool overlap(std::vector<const Change*> changes) {
  std::sort(changes.begin(), changes.end(),
            [](const Change* a, const Change* b) { return a->address < b->address; });
  return std::adjacent_find(changes.begin(), changes.end(), [](const Change* a, const Change* b) {
           return b->address < a->end();
         }) != changes.end();
}

/// A set of addresses, as intervals [begin, end) that neither overlap nor touch.
class Extents {
 public:
  void add(haddr_t begin, haddr_t end) {
    auto next = end_of_.upper_bound(begin);
    if (next != end_of_.begin() && std::prev(next)->second >= begin) --next;
    while (next != end_of_.end() && next->first <= end) {
      begin = std::min(begin, next->first);
      end = std::max(end, next->second);
      next = end_of_.erase(next);
    }
    end_of_.emplace(begin, end);
  }
  void add(const Extents& others) {
    for (const auto& [begin, end] : others.end_of_) add(begin, end);
  }
  bool meet(haddr_t begin, haddr_t end) const {
    const auto next = end_of_.lower_bound(end);
    return next != end_of_.begin() && std::prev(next)->second > begin;
  }

 private:
  std::map<haddr_t, haddr_t> end_of_;  ///< by begin
};

struct OrderedFile : H5FD_t {
  int descriptor = -1;
  bool writable = false;
  struct stat identity {};
  haddr_t end_of_addresses = 0;  ///< what HDF5 has given out
  haddr_t end_of_file = 0;       ///< on the disk
  Extents flushed;               ///< what the file on the disk may refer to
  Extents fresh;                 ///< what was written beside it since the last flush
  std::vector<Change> changes;   ///< in the order in which they came
  int error = 0;                 ///< errno of the first write that failed

  void write(H5FD_mem_t kind, haddr_t address, std::string_view bytes) {
    Change change{kind, address, std::string(bytes)};
    // Nothing on the disk refers to this place: HDF5 gives out addresses in blocks, so that such
    // places are also between those in use, not only at the end.
    const bool unused = !flushed.meet(address, change.end()) &&
                        std::none_of(changes.begin(), changes.end(), [&](const Change& earlier) {
                          return earlier.address < change.end() && address < earlier.end();
                        });
    if (!error && unused) {
      end_of_file = std::max(end_of_file, change.end());
      error = write_all(descriptor, address, bytes);
      if (!error) {
        fresh.add(address, change.end());
        return;
      }
    }
    std::erase_if(changes, [&](const Change& earlier) { return change.covers(earlier); });
    changes.push_back(std::move(change));
  }

  herr_t read(haddr_t address, std::size_t size, char* buffer) const {
    std::size_t got = 0;
    while (got < size) {
      const ssize_t n =
          pread(descriptor, buffer + got, size - got, static_cast<off_t>(address + got));
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return push_error("read");
      if (n == 0) break;
      got += static_cast<std::size_t>(n);
    }
    std::memset(buffer + got, 0, size - got);  // allocated, not written yet
    for (const Change& change : changes) {
      const haddr_t begin = std::max(address, change.address);
      const haddr_t end = std::min(address + size, change.end());
      if (begin < end)
        std::memcpy(buffer + (begin - address), change.bytes.data() + (begin - change.address),
                    end - begin);
    }
    return done;
  }

  void flush() {
    std::vector<const Change*> order;
    for (const Change& change : changes) order.push_back(&change);
    // Of two changes of the same bytes the later one counts: then the order is not ours to choose.
    if (!overlap(order))
      std::stable_sort(order.begin(), order.end(),
                       [](const Change* a, const Change* b) { return a->rank() < b->rank(); });
    for (const Change* change : order)
      if (!error) error = write_all(descriptor, change->address, change->bytes);
    if (error) return;
    for (const Change& change : changes) flushed.add(change.address, change.end());
    changes.clear();
    flushed.add(fresh);
    fresh = {};
    resize();
  }

  /// A file grows at once; it shrinks when nothing on the disk refers to its end any more.
  void resize() {
    const bool shrinks = end_of_addresses < end_of_file;
    if (error || end_of_addresses == end_of_file || (shrinks && !changes.empty())) return;
    if (ftruncate(descriptor, static_cast<off_t>(end_of_addresses)) != 0)
      error = errno;
    else
      end_of_file = end_of_addresses;
  }
};

OrderedFile& self(H5FD_t* file) {
  return *static_cast<OrderedFile*>(file);
}
const OrderedFile& self(const H5FD_t* file) {
  return *static_cast<const OrderedFile*>(file);
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) {
  const int mode = (flags & H5F_ACC_RDWR ? O_RDWR : O_RDONLY) |
                   (flags & H5F_ACC_TRUNC ? O_TRUNC : 0) | (flags & H5F_ACC_CREAT ? O_CREAT : 0) |
                   (flags & H5F_ACC_EXCL ? O_EXCL : 0);
  const int descriptor = ::open(name, mode | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    push_error("open");
    return nullptr;
  }
  auto* file = new OrderedFile{};
  file->descriptor = descriptor;
  file->writable = mode & O_RDWR;
  fstat(descriptor, &file->identity);
  file->end_of_file = static_cast<haddr_t>(file->identity.st_size);
  file->flushed.add(0, file->end_of_file);
  return file;
}

herr_t close_file(H5FD_t* file) {
  OrderedFile& ordered = self(file);
  if (ordered.writable) ordered.flush();
  close(ordered.descriptor);
  delete &ordered;
  return done;
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  const auto key = [](const H5FD_t* f) {
    return std::tuple(self(f).identity.st_dev, self(f).identity.st_ino);
  };
  return key(a) < key(b) ? -1 : key(b) < key(a) ? 1 : 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA |
             H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return done;
}

H5FD_class_t driver_class() {
  H5FD_class_t c{};
#if H5_VERSION_GE(1, 14, 0)
  c.version = H5FD_CLASS_VERSION;
  c.value = H5_VFD_RESERVED;  // the first number that HDF5 leaves to others
#endif
  c.name = "meniscus_ordered";
  c.maxaddr = HADDR_MAX;
  c.fc_degree = H5F_CLOSE_STRONG;
  c.open = open_file;
  c.close = close_file;
  c.cmp = compare;
  c.query = query;
  c.get_eoa = [](const H5FD_t* f, H5FD_mem_t) { return self(f).end_of_addresses; };
  c.set_eoa = [](H5FD_t* f, H5FD_mem_t, haddr_t end) {
    self(f).end_of_addresses = end;
    return done;
  };
  c.get_eof = [](const H5FD_t* f, H5FD_mem_t) { return self(f).end_of_file; };
  c.read = [](H5FD_t* f, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
    return self(f).read(address, size, static_cast<char*>(buffer));
  };
  c.write = [](H5FD_t* f, H5FD_mem_t kind, hid_t, haddr_t address, std::size_t size,
               const void* buffer) {
    self(f).write(kind, address, {static_cast<const char*>(buffer), size});
    return done;
  };
  c.flush = [](H5FD_t* f, hid_t, hbool_t) {
    self(f).flush();
    return done;
  };
  c.truncate = [](H5FD_t* f, hid_t, hbool_t) {
    self(f).resize();
    return done;
  };
  c.get_handle = [](H5FD_t* f, hid_t, void** handle) {
    *handle = &self(f).error;
    return done;
  };
  constexpr H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;  // raw data apart from metadata
  std::copy(std::begin(map), std::end(map), c.fl_map);
  return c;
}

}  // namespace

void use_ordered_writes(std::int64_t access) {
  static const H5FD_class_t properties = driver_class();
  static const hid_t driver = H5FDregister(&properties);
  check(driver, "prepare HDF5");
  check(H5Pset_driver(access, driver, nullptr), "prepare HDF5");
}

int write_error(std::int64_t file) {
  void* error = nullptr;
  check(H5Fget_vfd_handle(file, H5P_DEFAULT, &error), "write a file");
  return *static_cast<const int*>(error);
}

}  // namespace meniscus::hdf5
