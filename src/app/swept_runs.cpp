// SPDX-License-Identifier: BSD-3-Clause
// The runs of a sweep from its --set: all combinations, or a random sample.
#include "app/swept_runs.hpp"

#include "meniscus/error.hpp"
#include "numbers/random.hpp"
#include "numbers/types.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>
#include <string_view>

namespace meniscus {
namespace {

/// Throws InputError if a key is named twice.
std::vector<SweptKey> swept_keys(const std::vector<std::string>& settings) {
  std::vector<SweptKey> keys;
  for (const std::string& setting : settings) {
    keys.push_back(swept_key(setting));
    const auto same = [&](const SweptKey& k) { return k.key == keys.back().key; };
    if (std::count_if(keys.begin(), keys.end(), same) > 1)
      throw InputError(fmt::format("--set {}: the key is named twice", keys.back().key));
  }
  return keys;
}

std::vector<std::string> names_of_keys(const std::vector<SweptKey>& swept) {
  std::vector<std::string> keys;
  for (const SweptKey& key : swept) keys.push_back(key.key);
  return keys;
}

/// A number and the unit behind it, with the space between them.
struct Amount {
  Real number = 0;
  std::string unit;
};

/// Throws InputError if the text does not begin with a finite number.
Amount amount_of(const std::string& text, const SweptKey& of) {
  Amount amount;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, amount.number);
  amount.unit = std::string(rest, end);
  if (error != std::errc() || !std::isfinite(amount.number))
    throw InputError(fmt::format(
        "--set {}: '{}' is not a number; --random takes two bounds, such as gamma=50 mN/m,80 mN/m",
        of.key, text));
  return amount;
}

/// The two bounds of a key. Throws InputError.
std::pair<Amount, Amount> bounds_of(const SweptKey& key) {
  if (key.values.size() != 2)
    throw InputError(
        fmt::format("--set {}: has {} values; --random takes two bounds, such as gamma=50,80",
                    key.key, key.values.size()));
  const Amount low = amount_of(key.values[0], key), high = amount_of(key.values[1], key);
  if (low.unit != high.unit)
    throw InputError(
        fmt::format("--set {}: the bounds {} and {} have different units; allowed is one", key.key,
                    key.values[0], key.values[1]));
  if (!(low.number < high.number))
    throw InputError(fmt::format("--set {}: the bounds {} and {} do not rise", key.key,
                                 key.values[0], key.values[1]));
  return {low, high};
}

/// The numbers 0 ... n-1 in random order.
std::vector<int> shuffled(int n, std::mt19937_64& bits) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = order.size(); k > 1; --k)
    std::swap(order[k - 1], order[static_cast<std::size_t>(uniform(bits) * static_cast<Real>(k))]);
  return order;
}

/// The last part of a key, such as "gamma" of "surface_tension.drop.gamma". The whole key if
/// another key ends with the same part.
std::string short_name(const std::string& key, const std::vector<std::string>& keys) {
  const auto last = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  const auto same = std::count_if(keys.begin(), keys.end(),
                                  [&](const std::string& k) { return last(k) == last(key); });
  return same == 1 ? last(key) : key;
}

/// Without characters that file names should not contain.
std::string directory_of(const std::vector<std::string>& keys, const SweptRuns::Values& values) {
  std::string name;
  for (std::size_t i = 0; i < keys.size(); ++i)
    name += (i > 0 ? "," : "") + short_name(keys[i], keys) + "=" + values[i];
  for (char& c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       std::string_view("+-.,=_^").find(c) != std::string_view::npos;
    if (!plain) c = '_';
  }
  return name;
}

}  // namespace

SweptKey swept_key(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  SweptKey result{setting.substr(0, equals), {}};
  if (equals == std::string::npos || equals == 0)
    throw InputError(fmt::format(
        "--set {}: expected KEY=VALUE,VALUE,... such as body.drop.core=4,6,8", setting));
  std::string value;
  int depth = 0;
  char quote = 0;
  const auto end_value = [&] {
    const std::size_t first = value.find_first_not_of(' '), last = value.find_last_not_of(' ');
    if (first == std::string::npos)
      throw InputError(fmt::format("--set {}: a value is missing", setting));
    if (value[first] == '=' || value[first] == '@')  // a spreadsheet would evaluate it as a formula
      throw InputError(
          fmt::format("--set {}: a value begins with '{}'; allowed are numbers, texts "
                      "and formulas",
                      setting, value[first]));
    result.values.push_back(value.substr(first, last + 1 - first));
    value.clear();
  };
  for (const char c : setting.substr(equals + 1)) {
    if (quote == 0 && depth == 0 && c == ',') {
      end_value();
      continue;
    }
    if (c == '"' || c == '\'')
      quote = quote == 0 ? c : quote == c ? char{0} : quote;
    else if (quote == 0 && (c == '(' || c == '[' || c == '{'))
      ++depth;
    else if (quote == 0 && (c == ')' || c == ']' || c == '}'))
      --depth;
    value += c;
  }
  end_value();
  const std::set<std::string> different(result.values.begin(), result.values.end());
  if (different.size() < result.values.size())
    throw InputError(fmt::format("--set {}: a value is named twice", setting));
  return result;
}

SweptRuns combinations_of(const std::vector<std::string>& settings) {
  const std::vector<SweptKey> keys = swept_keys(settings);
  SweptRuns runs{names_of_keys(keys), {{}}};
  for (const SweptKey& key : keys) {
    std::vector<SweptRuns::Values> longer;
    for (const SweptRuns::Values& begun : runs.values)
      for (const std::string& value : key.values) {
        longer.push_back(begun);
        longer.back().push_back(value);
      }
    runs.values = std::move(longer);
  }
  return runs;
}

SweptRuns sample_of(const std::vector<std::string>& settings, int count) {
  const std::vector<SweptKey> keys = swept_keys(settings);
  SweptRuns runs{names_of_keys(keys),
                 std::vector<SweptRuns::Values>(static_cast<std::size_t>(count))};
  std::mt19937_64 bits(1);
  for (const SweptKey& key : keys) {
    const auto [low, high] = bounds_of(key);
    const std::vector<int> parts = shuffled(count, bits);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Real share = (parts[k] + uniform(bits)) / count;
      runs.values[k].push_back(
          fmt::format("{:.6g}{}", low.number + share * (high.number - low.number), low.unit));
    }
  }
  return runs;
}

std::vector<std::string> directories_of(const SweptRuns& runs) {
  constexpr std::size_t longest = 255;  // bytes of a file name
  std::vector<std::string> names;
  for (const SweptRuns::Values& values : runs.values) {
    names.push_back(directory_of(runs.keys, values));
    if (names.back().size() > longest)
      throw InputError(
          fmt::format("the directory of a run would be called '{}', which is too long; "
                      "[constants] of the scene give short values names",
                      names.back()));
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      throw InputError(
          fmt::format("two runs would have the directory '{}'; allowed are values that differ in "
                      "letters and digits",
                      names.back()));
  }
  return names;
}

}  // namespace meniscus
