// SPDX-License-Identifier: BSD-3-Clause
// Reading of regular files through the system, whose errors carry a reason.
#include "input/regular_file.hpp"

#include "meniscus/error.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <system_error>
#include <vector>

namespace meniscus {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw FileError(fmt::format("cannot read '{}': {}", path, reason));
}

[[noreturn]] void refuse(const std::string& path, int error_number) {
  refuse(path, std::generic_category().message(error_number));
}

const char* kind_of_file(mode_t mode) {
  return S_ISDIR(mode)    ? "a directory"
         : S_ISFIFO(mode) ? "a FIFO"
         : S_ISSOCK(mode) ? "a socket"
                          : "a device";
}

class Descriptor {
 public:
  // O_NONBLOCK: opening a FIFO would wait for a writer. Reading regular files is not changed by it.
  explicit Descriptor(const std::string& path)
      : number_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
    if (number_ < 0) refuse(path, errno);
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  operator int() const { return number_; }

 private:
  int number_;
};

}  // namespace

void read_regular_file(const std::string& path, std::uintmax_t most,
                       const std::function<void(std::string_view)>& take) {
  struct stat status {};
  // Check before opening: opening a device may already have an effect.
  if (stat(path.c_str(), &status) != 0) refuse(path, errno);
  const auto require_regular = [&] {
    if (!S_ISREG(status.st_mode))
      refuse(path, fmt::format("it is {}; expected is a file", kind_of_file(status.st_mode)));
  };
  require_regular();
  const Descriptor file(path);
  if (fstat(file, &status) != 0) refuse(path, errno);
  require_regular();
  const auto require_small = [&](std::uintmax_t size) {
    if (size > most)
      refuse(path, fmt::format("it has more than the {:.4g} MB that are possible here",
                               1e-6 * static_cast<double>(most)));
  };
  require_small(static_cast<std::uintmax_t>(status.st_size));
  std::vector<char> piece(1 << 16);
  std::uintmax_t size = 0;
  for (;;) {
    const ssize_t count = ::read(file, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(path, errno);
    if (count == 0) return;
    require_small(size += static_cast<std::uintmax_t>(count));  // the file may grow
    take({piece.data(), static_cast<std::size_t>(count)});
  }
}

std::string content_of_regular_file(const std::string& path, std::uintmax_t most) {
  std::string content;
  read_regular_file(path, most, [&](std::string_view piece) { content += piece; });
  return content;
}

}  // namespace meniscus
