// SPDX-License-Identifier: BSD-3-Clause
// Rows of keys that may be left out; the member then has no value.
#pragma once
#include "input/input.hpp"

namespace meniscus {

/// A number without a default value. `fallback` is the text of `meniscus keys` for an absent key.
template <class M>
Row<M> optional_row(std::string key, std::optional<Real> M::*member, Dimension dimension,
                    Range range, std::string fallback, std::string meaning) {
  Row<M> row = real_row<M>(std::move(key), nullptr, dimension, range, std::move(meaning), 0.0);
  row.fallback = std::move(fallback);
  row.read = [key = row.key, member, dimension, range](M& m, const Block& block) {
    if (block.has(key)) m.*member = block.real(key, dimension, range, std::nullopt);
  };
  return row;
}

/// A number, whose range is checked, or a formula of place and time; the key may be absent.
template <class M>
Row<M> optional_expression_row(std::string key, std::optional<Expression> M::*member,
                               Dimension dimension, Range range, std::string fallback,
                               std::string meaning) {
  Row<M> row = real_row<M>(std::move(key), nullptr, dimension, range, std::move(meaning), 0.0);
  row.type = "number or formula";
  row.fallback = std::move(fallback);
  row.read = [key = row.key, member, dimension, range](M& m, const Block& block) {
    if (block.has(key)) m.*member = block.expression(key, dimension, std::nullopt, range);
  };
  return row;
}

/// `count` formulas of these variables, or any number of them if count = 0. An absent key gives an
/// empty vector, which means zero.
template <class M>
Row<M> optional_expressions_row(std::string key, std::vector<Expression> M::*member,
                                std::size_t count, Dimension dimension, Variables variables,
                                std::string meaning) {
  Row<M> row = expressions_row<M>(std::move(key), nullptr, count, dimension, std::move(meaning),
                                  std::vector<Expression>{});
  row.fallback = "0";
  row.read = [key = row.key, member, count, dimension, variables](M& m, const Block& block) {
    if (block.has(key))
      m.*member = block.expressions(key, count, dimension, std::nullopt, variables);
  };
  return row;
}

}  // namespace meniscus
