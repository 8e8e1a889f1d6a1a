// SPDX-License-Identifier: BSD-3-Clause
// Memory of arrays that the time loop reads.
#include "parallel/aligned.hpp"

#include "parallel/parallel.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
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
  // This is a hint: a system without large pages uses others.
  if (static_cast<std::size_t>(alignment) == large_page) madvise(p, bytes, MADV_HUGEPAGE);
  return p;
}

void release_lines(void* p, std::size_t bytes) {
  ::operator delete(p, alignment_of(bytes));
}

void take_pages(void* begin, std::size_t bytes) {
  constexpr std::size_t page = 4096;
  auto* const first = static_cast<volatile char*>(begin);
  const std::size_t to_page = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
  parallel_for(
      static_cast<Index>(bytes / large_page + 1),
      [&](Index k) {
        const std::size_t start = static_cast<std::size_t>(k) * large_page,
                          end = std::min(start + large_page, bytes);
        for (std::size_t i = start + to_page; i < end; i += page) first[i] = 0;
      },
      1);
}

}  // namespace meniscus
