// SPDX-License-Identifier: BSD-3-Clause
// Parts that several users of one thing need alike: made by the first of them, kept as long as one
// has it.
#pragma once
#include <map>
#include <memory>
#include <string>

namespace meniscus {

class SharedParts {
 public:
  /// The part of this name, or what make() returns, a std::shared_ptr<T>. Parts of one name have
  /// one type. Not for several threads at once.
  template <class T, class Make>
  std::shared_ptr<T> get(const std::string& name, Make&& make) {
    std::weak_ptr<void>& kept = parts_[name];
    if (std::shared_ptr<void> part = kept.lock()) return std::static_pointer_cast<T>(part);
    std::shared_ptr<T> part = make();
    kept = part;
    return part;
  }

 private:
  std::map<std::string, std::weak_ptr<void>> parts_;
};

}  // namespace meniscus
