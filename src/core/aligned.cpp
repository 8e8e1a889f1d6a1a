// SPDX-License-Identifier: BSD-3-Clause
// Memory of arrays that the time loop reads.
#include "meniscus/core/aligned.hpp"

#include <sys/mman.h>

#include <new>

namespace meniscus {
namespace {

constexpr std::size_t cache_line = 64, large_page = 2 << 20;

std::align_val_t alignment_of(std::size_t bytes) {
  return std::align_val_t{bytes >= 2 * large_page ? large_page : cache_line};
}

}  // namespace

void* allocate_lines(std::size_t bytes) {
  const std::align_val_t alignment = alignment_of(bytes);
  void* const p = ::operator new(bytes, alignment);
  // A wish: where the system has no such pages, others do.
  if (static_cast<std::size_t>(alignment) == large_page) madvise(p, bytes, MADV_HUGEPAGE);
  return p;
}

void release_lines(void* p, std::size_t bytes) {
  ::operator delete(p, alignment_of(bytes));
}

}  // namespace meniscus
