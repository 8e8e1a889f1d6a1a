// SPDX-License-Identifier: BSD-3-Clause
// Orders writes: data before the structures that refer to them; trees of groups through a copy.
#include "io/hdf5_flush_order.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <string_view>
#include <utility>

namespace meniscus::hdf5 {
namespace {

using Order = std::vector<Change>;
using Changes = std::vector<const Change*>;

/// Reads an unsigned number of eight bytes, the size of all addresses and lengths in our files. 0
/// beyond the end.
std::uint64_t number(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

bool overlap(Changes changes) {
  std::sort(changes.begin(), changes.end(),
            [](const Change* a, const Change* b) { return a->address < b->address; });
  return std::adjacent_find(changes.begin(), changes.end(), [](const Change* a, const Change* b) {
           return b->address < a->end();
         }) != changes.end();
}

/// The heap with the names of a group. Its prefix has the address of the first free block; a free
/// block begins with the address of the next one and its own size.
struct Heap {
  static constexpr std::size_t prefix_size = 32;
  static constexpr std::uint64_t no_free_block = 1;
  static bool begins(std::string_view bytes) {
    return bytes.starts_with("HEAP") && bytes.size() >= prefix_size;
  }

  std::string prefix, data;

  haddr_t data_address() const { return number(prefix, 24); }
  std::uint64_t bytes_of_names() const {
    std::uint64_t sum = data.size(), at = number(prefix, 16);
    // A damaged file may lead in a circle: follow at most as many blocks as the heap can contain.
    for (std::size_t i = 0; i < data.size() / 16 && at != no_free_block; ++i) {
      sum -= number(data, at + 8);
      at = number(data, at);
    }
    return sum;
  }
  std::string prefix_without_free_blocks() const {
    std::string bytes = prefix;
    std::memcpy(bytes.data() + 16, &no_free_block, sizeof no_free_block);
    return bytes;
  }
};

Heap heap_at(haddr_t address, const auto& read) {
  Heap heap{read(address, Heap::prefix_size), {}};
  if (Heap::begins(heap.prefix)) heap.data = read(heap.data_address(), number(heap.prefix, 8));
  return heap;
}

/// Appends the changes of heaps. Heaps that gained names go to `order`; heaps that lost names go to
/// `after`, to be written when nothing refers to the lost names any more.
void order_heaps(const Changes& heaps, const Order& changes, const FileOnDisk& file, Order& order,
                 Order& after) {
  const auto then = [&](haddr_t at, std::size_t size) {
    std::string bytes = file.read(at, size);
    overlay(changes, at, bytes);
    return bytes;
  };
  for (const Change* change : heaps) {
    if (!Heap::begins(change->bytes)) {
      after.push_back(*change);  // data of a heap; usually its heap has already written them
      continue;
    }
    const Heap heap = heap_at(change->address, then), before = heap_at(change->address, file.read);
    const haddr_t data = heap.data_address();
    Order& to = heap.bytes_of_names() < before.bytes_of_names() ? after : order;
    // Names and free blocks overwrite each other; until both are written, the heap has no free
    // blocks.
    to.push_back({H5FD_MEM_LHEAP, change->address, heap.prefix_without_free_blocks()});
    to.push_back({H5FD_MEM_LHEAP, data, heap.data});
    to.push_back({H5FD_MEM_LHEAP, change->address, heap.prefix});
  }
}

/// An inner node of the tree of a group, or a leaf: a table of names and objects.
struct GroupNode {
  static bool begins(std::string_view bytes) {
    return bytes.starts_with("SNOD") || bytes.starts_with(std::string_view("TREE\0", 5));
  }

  const Change* change;
  bool has_parent = false;  ///< true if a parent is among the changes
  bool touches = false;     ///< true if it or a node below it is in use
  haddr_t copy = HADDR_UNDEF;

  bool is_leaf() const { return change->bytes.starts_with("SNOD"); }
  int level() const { return is_leaf() ? -1 : static_cast<unsigned char>(change->bytes.at(5)); }
  /// Offsets of the addresses of its children within its bytes.
  std::vector<std::size_t> children() const {
    constexpr std::size_t head = 32, next = 16;
    std::vector<std::size_t> places;
    if (is_leaf()) return places;
    const std::size_t count = number(change->bytes, 6) & 0xffff;
    for (std::size_t i = 0; i < count && head + next * i + 8 <= change->bytes.size(); ++i)
      places.push_back(head + next * i);
    return places;
  }
};

/// Appends the changes of group trees. When a node is split, the node and its parent change
/// together. Therefore a copy of all changed nodes below the highest one is written first. The
/// highest node refers to the copy until the nodes are written at their own addresses.
void order_groups(const Changes& changes, const FileOnDisk& file, Order& order) {
  std::map<haddr_t, GroupNode> nodes;
  std::vector<GroupNode*> by_level;
  for (const Change* change : changes)
    by_level.push_back(&nodes.insert_or_assign(change->address, GroupNode{change}).first->second);
  std::stable_sort(by_level.begin(), by_level.end(),
                   [](const GroupNode* a, const GroupNode* b) { return a->level() < b->level(); });
  const auto for_children = [&](const GroupNode& node, const auto& visit) {
    for (const std::size_t place : node.children())
      if (const auto child = nodes.find(number(node.change->bytes, place)); child != nodes.end())
        visit(child->second, place);
  };
  for (GroupNode* node : by_level) {
    node->touches = file.in_use(node->change->address, node->change->end());
    for_children(*node, [&](GroupNode& child, std::size_t) {
      child.has_parent = true;
      node->touches = node->touches || child.touches;
    });
  }
  const auto with_copies = [&](const GroupNode& node) {
    std::string bytes = node.change->bytes;
    for_children(node, [&](const GroupNode& child, std::size_t place) {
      if (child.copy != HADDR_UNDEF) std::memcpy(bytes.data() + place, &child.copy, 8);
    });
    return bytes;
  };
  for (const GroupNode* node : by_level)
    if (!node->touches) order.push_back(*node->change);
  for (GroupNode* node : by_level) {
    if (!node->touches || !node->has_parent) continue;
    node->copy = file.scratch(node->change->bytes.size());
    if (node->copy != HADDR_UNDEF)
      order.push_back({H5FD_MEM_BTREE, node->copy, with_copies(*node)});
  }
  std::reverse(by_level.begin(), by_level.end());
  for (const GroupNode* node : by_level)
    if (node->touches && !node->has_parent)
      order.push_back({H5FD_MEM_BTREE, node->change->address, with_copies(*node)});
  for (const GroupNode* node : by_level)
    if (node->touches && node->has_parent) order.push_back(*node->change);
  for (const GroupNode* node : by_level)
    if (node->touches && !node->has_parent && !node->is_leaf()) order.push_back(*node->change);
}

/// True for nodes of chunk trees. They begin with "TREE", type 1, and the level, which is 0 for
/// leaves.
bool is_chunk_node(std::string_view bytes) {
  return bytes.starts_with(std::string_view("TREE\1", 5)) && bytes.size() > 5;
}

}  // namespace

void overlay(const Order& changes, haddr_t address, std::span<char> bytes) {
  for (const Change& change : changes) {
    const haddr_t begin = std::max(address, change.address);
    const haddr_t end = std::min(address + bytes.size(), change.end());
    if (begin < end)
      std::memcpy(bytes.data() + (begin - address), change.bytes.data() + (begin - change.address),
                  end - begin);
  }
}

Order flush_order(const Order& changes, const FileOnDisk& file) {
  Changes all, raw, super, heaps, chunks, groups, others;
  for (const Change& change : changes) {
    all.push_back(&change);
    (change.kind == H5FD_MEM_DRAW      ? raw
     : change.kind == H5FD_MEM_SUPER   ? super
     : change.kind == H5FD_MEM_LHEAP   ? heaps
     : is_chunk_node(change.bytes)     ? chunks
     : GroupNode::begins(change.bytes) ? groups
                                       : others)
        .push_back(&change);
  }
  if (overlap(all)) return changes;

  Order order, after;
  const auto append = [&order](const Changes& some) {
    for (const Change* change : some) order.push_back(*change);
  };
  append(raw);
  append(super);
  order_heaps(heaps, changes, file, order, after);
  // When a node of a chunk tree is split, half of its chunks move to a new node. The parent must
  // refer to the new node before the old one loses these chunks: readers search from the top.
  const auto level = [](const Change* node) { return static_cast<unsigned char>(node->bytes[5]); };
  std::stable_sort(chunks.begin(), chunks.end(), [&](const Change* a, const Change* b) {
    const bool a_used = file.in_use(a->address, a->end()),
               b_used = file.in_use(b->address, b->end());
    return std::pair(a_used, -level(a)) < std::pair(b_used, -level(b));
  });
  append(chunks);
  order_groups(groups, file, order);
  order.insert(order.end(), after.begin(), after.end());
  append(others);
  return order;
}

}  // namespace meniscus::hdf5
