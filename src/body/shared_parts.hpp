// SPDX-License-Identifier: BSD-3-Clause
// Parts that several users share: the first user makes a part, and it lives as long as it has
// users.
#pragma once
#include <map>
#include <memory>
#include <string>

namespace meniscus {

class SharedParts {
 public:
  /// Returns the part called `name`. If it does not exist, make() has to return it as
  /// std::shared_ptr<T>. All parts of one name have one type. Not thread safe.
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
