// SPDX-License-Identifier: BSD-3-Clause
// Exceptions and their messages.
#pragma once
#include <gtest/gtest.h>

#include <string>

/// Expects an exception whose message contains `part`.
#define EXPECT_THROW_WITH(statement, exception, part)                                     \
  try {                                                                                   \
    (void)(statement);                                                                    \
    ADD_FAILURE() << #statement " threw nothing";                                         \
  } catch (const exception& thrown) {                                                     \
    EXPECT_NE(std::string(thrown.what()).find(part), std::string::npos) << thrown.what(); \
  }
