// SPDX-License-Identifier: BSD-3-Clause
// Scans an XML text in one pass and returns its tags and the text between them.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

struct XmlPiece {
  enum class Kind { open, close, text, end };
  Kind kind;
  std::string_view name;     ///< name of the element
  std::string_view content;  ///< the text, or the attributes of an opening tag
  int line;                  ///< line in which the piece begins
};

/// Skips comments, declarations and processing instructions, and does not expand entities. A tag
/// <a/> is returned as an opening and a closing tag. All members throw InputError, "FILE: line N:
/// ...".
class XmlScanner {
 public:
  XmlScanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  XmlPiece next();
  /// The attributes of an opening tag by their names.
  std::map<std::string, std::string> attributes(const XmlPiece& tag) const;
  /// The unread rest of the text.
  std::string_view rest() const { return text_.substr(at_); }
  /// Number of open elements.
  std::size_t depth() const { return open_.size(); }
  [[noreturn]] void fail(const std::string& what, int line) const;

 private:
  /// Moves on behind `end`, counts lines, and returns the text before `end`. `inside_of` is for the
  /// message if `end` is missing.
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
