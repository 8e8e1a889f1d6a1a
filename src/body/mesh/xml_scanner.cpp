// SPDX-License-Identifier: BSD-3-Clause
// Scans an XML text in one pass.
#include "body/mesh/xml_scanner.hpp"

#include "body/mesh/mesh_text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

constexpr std::string_view xml_space = " \t\r\n";

int count_of_lines(std::string_view text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

void XmlScanner::fail(const std::string& what, int line) const {
  throw InputError(fmt::format("{}: line {}: {}", name_, line, what));
}

std::string_view XmlScanner::until(std::string_view end, std::string_view inside_of) {
  const std::size_t place = text_.find(end, at_);
  if (place == text_.npos)
    fail(fmt::format("{} does not end; expected is {}", inside_of, end), line_);
  const std::string_view before = text_.substr(at_, place - at_);
  line_ += count_of_lines(before);
  at_ = place + end.size();
  return before;
}

/// Reads the text between < and >. A > within quotes belongs to a value.
std::string_view XmlScanner::tag() {
  const std::size_t begin = at_;
  char quote = 0;
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (quote ? c == quote : c == '"' || c == '\'')
      quote = quote ? 0 : c;
    else if (!quote && (c == '>' || c == '<'))
      break;
  }
  if (at_ == text_.size() || text_[at_] == '<') fail("a tag does not end; expected is >", line_);
  const std::string_view inside = text_.substr(begin, at_++ - begin);
  line_ += count_of_lines(inside);
  return inside;
}

XmlPiece XmlScanner::next() {
  if (closes_) {
    closes_ = false;
    const std::string_view name = open_.back();
    open_.pop_back();
    return {XmlPiece::Kind::close, name, {}, line_};
  }
  for (;;) {
    const int line = line_;
    if (at_ == text_.size()) {
      if (!open_.empty())
        fail(fmt::format("the file ends in <{}>; expected is </{}>", MeshText::shown(open_.back()),
                         MeshText::shown(open_.back())),
             line);
      return {XmlPiece::Kind::end, {}, {}, line};
    }
    if (text_[at_] != '<') {
      const std::size_t begin = at_;
      at_ = std::min(text_.find('<', at_), text_.size());
      const std::string_view text = text_.substr(begin, at_ - begin);
      line_ += count_of_lines(text);
      return {XmlPiece::Kind::text, open_.empty() ? std::string_view{} : open_.back(), text, line};
    }
    ++at_;
    if (rest().starts_with("!--")) {
      until("-->", "a comment");
    } else if (rest().starts_with("?")) {
      until("?>", "a processing instruction");
    } else if (rest().starts_with("!")) {
      fail("a declaration <! is not read; expected are elements and comments", line);
    } else {
      std::string_view inside = tag();
      const bool closing = inside.starts_with('/');
      if (closing) inside.remove_prefix(1);
      const bool empty = !closing && inside.ends_with('/');
      if (empty) inside.remove_suffix(1);
      const std::string_view name = inside.substr(0, inside.find_first_of(xml_space));
      if (name.empty()) fail("a tag has no name", line);
      if (closing) {
        if (open_.empty() || open_.back() != name)
          fail(fmt::format("</{}> closes nothing; expected is {}", MeshText::shown(name),
                           open_.empty() ? "the end of the file"
                                         : fmt::format("</{}>", MeshText::shown(open_.back()))),
               line);
        open_.pop_back();
        return {XmlPiece::Kind::close, name, {}, line};
      }
      constexpr std::size_t deepest = 100;
      if (open_.size() == deepest)
        fail(fmt::format("more than {} elements are inside each other", deepest), line);
      open_.push_back(name);
      closes_ = empty;
      return {XmlPiece::Kind::open, name, inside.substr(name.size()), line};
    }
  }
}

std::map<std::string, std::string> XmlScanner::attributes(const XmlPiece& tag) const {
  std::map<std::string, std::string> found;
  std::string_view left = tag.content;
  const auto skip_space = [&] {
    left.remove_prefix(std::min(left.find_first_not_of(xml_space), left.size()));
  };
  for (skip_space(); !left.empty(); skip_space()) {
    const std::size_t equals = left.find('=');
    const std::string_view before = left.substr(0, equals);
    const std::string_view key = before.substr(0, before.find_last_not_of(xml_space) + 1);
    left.remove_prefix(std::min(before.size() + 1, left.size()));
    skip_space();
    const std::size_t close = left.empty() ? left.npos : left.find(left.front(), 1);
    if (key.empty() || equals == left.npos || close == left.npos ||
        (left.front() != '"' && left.front() != '\''))
      fail(fmt::format("an attribute of <{}> is not understood; expected is key=\"value\"",
                       MeshText::shown(tag.name)),
           tag.line);
    if (!found.emplace(key, left.substr(1, close - 1)).second)
      fail(fmt::format("<{}> has the attribute {} twice", MeshText::shown(tag.name),
                       MeshText::shown(key)),
           tag.line);
    left.remove_prefix(close + 1);
  }
  return found;
}

}  // namespace meniscus
