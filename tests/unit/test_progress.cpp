// SPDX-License-Identifier: BSD-3-Clause
// Messages about the progress of a run, with a simulated clock.
#include "app/progress.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace meniscus::test_progress {
namespace {

/// A run with a simulated clock.
struct Told {
  State state;
  double now = 1000;
  std::vector<std::string> log;
  Progress progress;

  explicit Told(Real end, Progress::Shown shown = Progress::Shown::in_log_only,
                bool may_end_earlier = false)
      : progress(
            state, end, {"ns", "aJ", may_end_earlier}, shown,
            [this](const std::string& line) { log.push_back(line); }, [this] { return now; }) {}

  void step(Real dt, double seconds) {
    now += seconds;
    state.time += dt;
    ++state.step;
    progress.show(state, dt, std::nullopt);
  }
  void steps(int count, Real dt, double seconds) {
    for (int k = 0; k < count; ++k) step(dt, seconds);
  }
};

bool says(const std::string& line, const std::string& words) {
  return line.find(words) != line.npos;
}

TEST(Progress, ALineAfterTenSecondsThenEveryMinute) {
  Told told(100);
  told.steps(39, 0.01, 0.25);
  EXPECT_TRUE(told.log.empty());  // 9.75 s
  told.step(0.01, 0.25);
  EXPECT_EQ(told.log.size(), 1u);
  told.steps(239, 0.01, 0.25);
  EXPECT_EQ(told.log.size(), 1u);  // 69.75 s
  told.step(0.01, 0.25);
  EXPECT_EQ(told.log.size(), 2u);
  told.step(0.01, 600);
  EXPECT_EQ(told.log.size(), 3u);  // several due messages are given once
}

TEST(Progress, ALongStepSaysHowFarItHasCome) {
  Told told(100);
  told.progress.within(told.state, 0.5, "iteration 2");
  EXPECT_TRUE(told.log.empty());
  told.now += 11;
  told.progress.within(told.state, 0.5, "");  // nothing is known
  EXPECT_TRUE(told.log.empty());
  told.progress.within(told.state, 0.5, "iteration 3");
  told.progress.within(told.state, 0.5, "iteration 4");
  EXPECT_EQ(told.log, std::vector<std::string>{"step 1 to t = 0.5 of 100 ns: iteration 3"});
}

TEST(Progress, ASteadyRunKnowsWhenItEnds) {
  Told told(100);
  Ledger ledger;
  ledger.kinetic = 2;
  ledger.stored["strain"] = 0.5;
  told.progress.show(told.state, 0.01, ledger);
  told.steps(2000, 0.01, 0.125);  // 250 s, a fifth of the way
  EXPECT_EQ(told.log.back(),
            "step 2000, t = 20 of 100 ns (20.0 %), dt = 0.01, 8 steps/s, about 17 min left; "
            "kinetic 2, strain 0.5 aJ");
}

TEST(Progress, ARunThatMayComeToRestKnowsTheLatestTime) {
  Told told(100, Progress::Shown::in_log_only, true);
  told.steps(100, 0.01, 0.125);
  EXPECT_TRUE(says(told.log.front(), "at most 21 min left")) << told.log.front();
}

TEST(Progress, NoTimeLeftBeforeTenSteps) {
  Told told(100);
  told.steps(9, 1, 70);
  ASSERT_EQ(told.log.size(), 9u);
  for (const std::string& line : told.log) EXPECT_TRUE(says(line, ", time left unknown")) << line;
  told.step(1, 140);
  EXPECT_TRUE(says(told.log.back(), "77 s per step, the last took 2 min, about 115 min left") ||
              says(told.log.back(), "77 s per step, the last took 2 min, about 1.9 h left"))
      << told.log.back();
}

/// Without the check, a run that never ends would report between a minute and an hour left.
TEST(Progress, NoTimeLeftWhileTheStepCollapses) {
  Told told(100);
  told.steps(400, 0.01, 0.25);
  EXPECT_TRUE(says(told.log.back(), "min left"));
  Real dt = 0.01;
  for (int k = 0; k < 4000; ++k) {
    dt *= std::exp2(-1.0 / 120);  // halved every half minute
    told.step(dt, 0.25);
  }
  for (std::size_t k = 3; k < told.log.size(); ++k)
    EXPECT_TRUE(says(told.log[k], "time left unknown")) << told.log[k];
  told.steps(600, dt, 0.25);  // the step stays short: the time left is known again
  EXPECT_TRUE(says(told.log.back(), " days left")) << told.log.back();
}

TEST(Progress, ThePaceIsThatOfTheLastMinute) {
  State state;
  Pace pace(0, state);
  double now = 0;
  const auto steps = [&](int count, double seconds) {
    for (int k = 0; k < count; ++k) {
      state.time += 1;
      ++state.step;
      pace.add(now += seconds, state, 1);
    }
  };
  steps(1000, 1);
  EXPECT_NEAR(pace.steps_per_second(), 1, 1e-12);
  EXPECT_NEAR(pace.seconds_to(state.time + 50).value(), 50, 1e-9);
  steps(800, 0.1);  // ten times as fast
  EXPECT_NEAR(pace.steps_per_second(), 10, 1e-9);
  steps(20, 30);  // much slower: the pace is that of ten steps, of any duration
  EXPECT_NEAR(pace.steps_per_second(), 1.0 / 30, 1e-9);
  EXPECT_EQ(pace.seconds_of_last_step(), 30);
}

TEST(Progress, LinesAreFlushedAndATerminalHasOne) {
  for (const bool terminal : {false, true}) {
    testing::internal::CaptureStdout();
    Told told(100, terminal ? Progress::Shown::on_terminal : Progress::Shown::in_lines);
    told.steps(2, 0.1, 5);
    told.progress.finish();
    const std::string text = testing::internal::GetCapturedStdout();
    const std::string line = told.log.at(0);
    const auto count = [&](const std::string& words) {
      std::size_t n = 0;
      for (std::size_t k = text.find(words); k != text.npos; k = text.find(words, k + 1)) ++n;
      return n;
    };
    EXPECT_TRUE(terminal ? text.ends_with("\r\033[K" + line + "\r\033[K") : text == line + "\n")
        << text;
    EXPECT_EQ(count("\r"), terminal ? 3u : 0u);
  }
}

}  // namespace
}  // namespace meniscus::test_progress
