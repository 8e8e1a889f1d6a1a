// SPDX-License-Identifier: BSD-3-Clause
// Tags of an XML text and the text between them, one after the other, in one pass.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

struct XmlPiece {
  enum class Kind { open, close, text, end };
  Kind kind;
  std::string_view name;     ///< of the element
  std::string_view content;  ///< of a text; of an opening tag, its attributes
  int line;                  ///< where it begins
};

/// Comments, declarations and processing instructions are skipped; entities stay as they are. A tag
/// <a/> is an opening and a closing one. All members throw InputError, "FILE: line N: ...".
class XmlScanner {
 public:
  XmlScanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  XmlPiece next();
  /// The attributes of an opening tag by their names.
  std::map<std::string, std::string> attributes(const XmlPiece& tag) const;
  /// What is not read yet.
  std::string_view rest() const { return text_.substr(at_); }
  /// How many elements are open.
  std::size_t depth() const { return open_.size(); }
  [[noreturn]] void fail(const std::string& what, int line) const;

 private:
  /// Moves on to `end`, which is read with the lines on the way, and returns what is before it.
  std::string_view until(std::string_view end, std::string_view inside_of);
  std::string_view tag();

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool closes_ = false;  ///< the last tag was <a/>
  std::vector<std::string_view> open_;
};

}  // namespace meniscus
