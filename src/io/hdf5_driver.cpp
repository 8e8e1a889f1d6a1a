// SPDX-License-Identifier: BSD-3-Clause
// The HDF5 file driver that orders its writes (virtual file layer of HDF5 1.10 to 1.14).
#include "io/hdf5_driver.hpp"

#include <fcntl.h>
#include <hdf5.h>
#if H5_VERSION_GE(1, 14, 0)
#include <H5FDdevelop.h>
#endif
#include "io/hdf5_file.hpp"
#include "io/hdf5_flush_order.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus::hdf5 {
namespace {

constexpr herr_t done = 0;
constexpr haddr_t page = 4096;  ///< size of a memory page, or a divisor of it

/// Puts the reason of a failure on the error stack of HDF5, from which hdf5::check() makes its
/// messages.
herr_t push_error(const char* what) {
  H5Epush2(H5E_DEFAULT, __FILE__, what, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_CANTOPENFILE,
           "%s, error message = '%s'", what, std::strerror(errno));
  return -1;
}

/// Writes all bytes. Returns 0 or errno.
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

/// A set of addresses, stored as intervals [begin, end) that neither overlap nor touch.
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
  std::map<haddr_t, haddr_t> end_of_;  ///< [begin] end of an interval
};

struct OrderedFile : H5FD_t {
  int descriptor = -1;
  bool writable = false;
  struct stat identity {};
  haddr_t end_of_addresses = 0;  ///< end of the addresses that HDF5 uses
  haddr_t end_of_file = 0;       ///< size on the disk
  haddr_t next = 0;              ///< end of all addresses ever allocated; none is used twice
  haddr_t room_begin = 0, room_end = 0;  ///< free part of the present metadata page
  haddr_t scratch_begin = 0;             ///< a page for copies during a flush
  Extents flushed;                       ///< addresses that the file on the disk may refer to
  Extents fresh;                         ///< other addresses written since the last flush
  std::vector<Change> changes;           ///< changes in memory, in order
  int error = 0;                         ///< errno of the first write that failed

  /// Allocates addresses. Metadata lie within one memory page, because a killed process has written
  /// a page completely or not at all. No address is allocated twice, so that new data can be
  /// written before old data are abandoned.
  haddr_t allocate(H5FD_mem_t kind, haddr_t size) {
    if (scratch_begin == 0) scratch_begin = new_page();
    if (kind == H5FD_MEM_DRAW || size > page) {
      next = std::max(next, end_of_addresses);
      end_of_addresses = next + size;
      return std::exchange(next, end_of_addresses);
    }
    if (size > room_end - room_begin) {
      room_begin = new_page();
      room_end = room_begin + page;
    }
    return std::exchange(room_begin, room_begin + size);
  }

  haddr_t new_page() {
    const haddr_t begin = (std::max(next, end_of_addresses) + page - 1) / page * page;
    end_of_addresses = next = begin + page;
    return begin;
  }

  void write(H5FD_mem_t kind, haddr_t address, std::string_view bytes) {
    Change change{kind, address, std::string(bytes)};
    const bool unused = !flushed.meet(address, change.end()) &&
                        std::none_of(changes.begin(), changes.end(), [&](const Change& earlier) {
                          return earlier.address < change.end() && address < earlier.end();
                        });
    if (!error && unused && kind != H5FD_MEM_BTREE) {
      put(address, bytes);
      if (!error) {
        fresh.add(address, change.end());
        return;
      }
    }
    std::erase_if(changes, [&](const Change& earlier) { return change.covers(earlier); });
    changes.push_back(std::move(change));
  }

  void put(haddr_t address, std::string_view bytes) {
    end_of_file = std::max(end_of_file, address + bytes.size());
    error = write_all(descriptor, address, bytes);
  }

  /// Reads bytes. Returns 0 or errno. Beyond the end of the file, where addresses are allocated but
  /// not written, bytes are zero.
  int get(haddr_t address, std::size_t size, char* buffer) const {
    std::size_t got = 0;
    while (got < size) {
      const ssize_t n =
          pread(descriptor, buffer + got, size - got, static_cast<off_t>(address + got));
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return errno;
      if (n == 0) break;
      got += static_cast<std::size_t>(n);
    }
    std::memset(buffer + got, 0, size - got);
    return 0;
  }

  herr_t read(haddr_t address, std::size_t size, char* buffer) const {
    if (get(address, size, buffer) != 0) return push_error("read");
    overlay(changes, address, {buffer, size});
    return done;
  }

  void flush() {
    if (end_of_file < end_of_addresses) resize();
    haddr_t scratch = scratch_begin;
    const FileOnDisk on_disk{
        [this](haddr_t address, std::size_t size) {
          std::string bytes(size, 0);
          if (const int failed = get(address, size, bytes.data())) error = failed;
          return bytes;
        },
        [this](haddr_t begin, haddr_t end) { return flushed.meet(begin, end); },
        [this, &scratch](std::size_t size) {
          if (scratch_begin == 0 || scratch + size > scratch_begin + page) return HADDR_UNDEF;
          return std::exchange(scratch, scratch + size);
        }};
    for (const Change& change : flush_order(changes, on_disk))
      if (!error) put(change.address, change.bytes);
    if (error) return;
    for (const Change& change : changes) flushed.add(change.address, change.end());
    changes.clear();
    flushed.add(fresh);
    fresh = {};
    resize();
  }

  /// Sets the size of the file. It grows at once, but shrinks only when nothing on the disk refers
  /// to its end any more.
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
  if (flags) *flags = H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return done;
}

H5FD_class_t driver_class() {
  H5FD_class_t c{};
#if H5_VERSION_GE(1, 14, 0)
  c.version = H5FD_CLASS_VERSION;
  c.value = H5_VFD_RESERVED;  // the first number that HDF5 leaves to other drivers
#endif
  c.name = "meniscus_ordered";
  c.maxaddr = HADDR_MAX;
  c.fc_degree = H5F_CLOSE_STRONG;
  c.open = open_file;
  c.close = close_file;
  c.cmp = compare;
  c.query = query;
  c.alloc = [](H5FD_t* f, H5FD_mem_t kind, hid_t, hsize_t size) {
    return self(f).allocate(kind, size);
  };
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
  constexpr H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;  // separates raw data from metadata
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
