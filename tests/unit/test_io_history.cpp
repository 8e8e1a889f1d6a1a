// SPDX-License-Identifier: BSD-3-Clause
// History and log.
#include "io/history.hpp"
#include "io/run_log.hpp"
#include "meniscus/error.hpp"
#include "unit/io_helpers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace meniscus::test_io_history {
namespace {

class Histories : public TemporaryDirectory {
 protected:
  Histories() { std::filesystem::create_directory(path()); }

  std::filesystem::path file() const { return path() / "history.csv"; }
  void write(std::initializer_list<Real> times, std::optional<Real> continue_after = {}) {
    HistoryWriter history(file(), columns_, continue_after);
    for (const Real t : times) history.write(std::vector<Real>{t, 1 / (3 + t)});
  }
  std::vector<Real> times() const { return History::read(file()).column("time"); }

  std::vector<HistoryColumn> columns_ = {{"time", "ps"}, {"aspect"}};
};

TEST_F(Histories, ReadBackBitForBit) {
  write({0, 0.1, 1e-300});
  const History history = History::read(file());
  EXPECT_EQ(history.columns(), columns_);
  EXPECT_EQ(history.column("time"), (std::vector<Real>{0, 0.1, 1e-300}));
  EXPECT_EQ(history.column("aspect"), (std::vector<Real>{1.0 / 3.0, 1 / (3 + 0.1), 1.0 / 3.0}));
  EXPECT_TRUE(history.has("aspect"));
  EXPECT_THROW_WITH(history.column("energy"), FileError, "it has: time, aspect");
}

TEST_F(Histories, RowsAreOutAtOnce) {
  HistoryWriter history(file(), columns_);
  history.write(std::vector<Real>{0.5, 2});
  EXPECT_EQ(content(file()), "# time,aspect\n# ps,1\n0.5,2\n");
}

TEST_F(Histories, ContinuationCutsLaterRows) {
  write({0, 0.1, 0.2, 0.3});
  write({0.25}, 0.2);
  EXPECT_EQ(times(), (std::vector<Real>{0, 0.1, 0.2, 0.25}));
}

TEST_F(Histories, ContinuationCutsAnIncompleteRow) {
  write({0, 0.1});
  std::ofstream(file(), std::ios::app) << "0.2,0.31";
  EXPECT_EQ(times(), (std::vector<Real>{0, 0.1}));
  write({0.5}, 1.0);
  EXPECT_EQ(times(), (std::vector<Real>{0, 0.1, 0.5}));
}

TEST_F(Histories, ContinuationWithOtherColumnsIsRefused) {
  write({0});
  columns_[1].unit = "m";
  EXPECT_THROW_WITH(write({1}, 0.0), FileError, "columns differ");
}

TEST_F(Histories, DamagedFilesAreNamedByLine) {
  std::ofstream(file()) << "# time,a\n# s,1\n0,1\n0.1\n";
  EXPECT_THROW_WITH(History::read(file()), FileError, "history.csv:4: 1 values for 2 columns");
  std::ofstream(file()) << "# time,a\n# s,1\n0,x\n";
  EXPECT_THROW_WITH(History::read(file()), FileError, ":3: 'x' is not a number");
  std::ofstream(file()) << "0,1\n";
  EXPECT_THROW_WITH(History::read(file()), FileError, "not a history");
  EXPECT_THROW_WITH(History::read(path() / "absent"), FileError, "cannot read");
}

TEST_F(Histories, WhatIsNotFiniteIsRefusedAndNotWritten) {
  HistoryWriter history(file(), columns_);
  history.write(std::vector<Real>{0, 2});
  const std::string before = content(file());
  EXPECT_THROW_WITH(history.write(std::vector<Real>{0.5, std::nan("")}), SolveError,
                    "time = 0.5: the column 'aspect' of history.csv would be not a number");
  EXPECT_THROW_WITH(history.write(std::vector<Real>{0.5, -1 / 0.0}), SolveError,
                    "would be infinite");
  EXPECT_EQ(content(file()), before);
}

TEST_F(Histories, LogGoesToFileAndWarningsToStderr) {
  testing::internal::CaptureStderr();
  {
    RunLog log(path() / "run.log");
    log.info("step {} of 10");
    log.warning("support enlarged");
    log.error("J <= 0");
    EXPECT_EQ(log.warnings(), (std::vector<std::pair<std::string, int>>{{"support enlarged", 1}}));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: support enlarged\nerror: J <= 0\n");
  const std::string text = content(path() / "run.log");
  EXPECT_NE(text.find("Z info: step {} of 10\n"), text.npos) << text;
  EXPECT_NE(text.find("Z error: J <= 0\n"), text.npos) << text;
  EXPECT_THROW_WITH(RunLog(path() / "run.log" / "below a file"), FileError, "cannot write");
}

TEST(RunLogs, EachWarningIsKeptOnce) {
  testing::internal::CaptureStderr();
  RunLog log;
  for (const char* text : {"b", "a", "b", "b"}) log.warning(text);
  log.info("c");
  log.error("d");
  EXPECT_EQ(log.warnings(), (std::vector<std::pair<std::string, int>>{{"b", 3}, {"a", 1}}));
  testing::internal::GetCapturedStderr();
}

}  // namespace
}  // namespace meniscus::test_io_history
