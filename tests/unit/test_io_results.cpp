// SPDX-License-Identifier: BSD-3-Clause
// Result files: refusal, bad numbers, continuation, states of frames, full disks.
#include "io/checkpoint.hpp"
#include "io/info.hpp"
#include "io/result_file.hpp"
#include "meniscus/error.hpp"
#include "unit/io_helpers.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <limits>

namespace meniscus::test_io_results {
namespace {

class Results : public TemporaryDirectory {
 protected:
  static constexpr Index particles = 5;

  ResultFile open(const RunDirectory& directory, ResultOptions options = {}) {
    const ResultField drop[] = {{"X", 2, "m", std::span<const Real>(X_).first(4)}};
    const ResultField wall[] = {{"X", 2, "m", std::span<const Real>(X_).subspan(4)}};
    const BodyReference bodies[] = {{"drop", {drop[0]}, 4, corners_, {}},
                                    {"wall", {wall[0]}, 4, corners_, {}}};
    return {directory, provenance("test", input_), bodies, options};
  }

  /// Writes a frame whose numbers depend on its step.
  std::int64_t write(ResultFile& file, std::int64_t step, const Snapshot* state = nullptr) {
    std::vector<Real> x(2 * particles, static_cast<Real>(step));
    const ResultField fields[] = {{"position", 2, "m", x},
                                  {"pressure", 1, "Pa", std::span<const Real>(x).first(particles)}};
    return file.write_frame(step, 0.1 * static_cast<Real>(step), fields, state);
  }

  std::vector<Real> X_ = std::vector<Real>(2 * particles, 0.25);
  const std::vector<Index> corners_ = {0, 1, 1, 0};
  std::string input_ = "dimension = 2\n";
};

TEST_F(Results, DirectoryThatHoldsARunIsRefusedUnlessItIsToBeReplaced) {
  {
    const RunDirectory directory(path(), ExistingRun::refuse);
    ResultFile file = open(directory);
    write(file, 0);
  }
  std::ofstream(path() / "notes.txt") << "mine";
  EXPECT_THROW_WITH(RunDirectory(path(), ExistingRun::refuse), FileError, "--overwrite");
  const RunDirectory directory(path(), ExistingRun::replace);
  EXPECT_FALSE(std::filesystem::exists(directory.result_file()));
  EXPECT_TRUE(std::filesystem::exists(path() / "notes.txt"));
}

TEST_F(Results, TwoRunsCannotWriteToOneDirectory) {
  const RunDirectory directory(path(), ExistingRun::refuse);
  EXPECT_THROW_WITH(RunDirectory(path(), ExistingRun::replace), FileError, "another run");
}

TEST_F(Results, ImpossibleDirectoriesAreNamed) {
  std::ofstream(path()) << "a file";
  EXPECT_THROW_WITH(RunDirectory(path(), ExistingRun::refuse), FileError, path().string());
  EXPECT_THROW_WITH(RunDirectory("/proc/nowhere/results", ExistingRun::refuse), FileError,
                    "cannot make the directory '/proc/nowhere/results'");
}

TEST_F(Results, BadNumbersAreRefusedByFieldAndParticle) {
  const RunDirectory directory(path(), ExistingRun::refuse);
  ResultFile file = open(directory);
  write(file, 0);
  std::vector<Real> x(2 * particles, 1.0);
  x[7] = std::numeric_limits<Real>::quiet_NaN();
  const ResultField nan[] = {{"position", 2, "m", x}};
  EXPECT_THROW_WITH(file.write_frame(3, 0, nan), SolveError,
                    "the field 'position' is nan at particle 1 of body 'wall' in step 3");
  x[7] = -std::numeric_limits<Real>::infinity();
  const ResultField infinite[] = {{"position", 2, "m", x}};
  EXPECT_THROW(file.write_frame(3, 0, infinite), SolveError);
  EXPECT_EQ(write(file, 3), 1);
}

TEST_F(Results, NumbersTooLargeForSinglePrecisionAreRefused) {
  const RunDirectory directory(path(), ExistingRun::refuse);
  ResultFile file = open(directory, {.precision = ResultOptions::Precision::float32});
  const std::vector<Real> x(2 * particles, 1e39);
  const ResultField fields[] = {{"position", 2, "m", x}};
  EXPECT_THROW_WITH(file.write_frame(0, 0, fields), SolveError, "too large for float32");
}

TEST_F(Results, FramesHaveTheSameFields) {
  const RunDirectory directory(path(), ExistingRun::refuse);
  ResultFile file = open(directory);
  write(file, 0);
  const std::vector<Real> x(2 * particles, 1.0);
  const ResultField fields[] = {{"position", 2, "m", x}};
  EXPECT_THROW_WITH(file.write_frame(1, 1, fields), FileError, "pressure (1, Pa)");
}

TEST_F(Results, ContinuationDropsLaterFramesAndGoesOn) {
  {
    const RunDirectory directory(path(), ExistingRun::refuse);
    ResultFile file = open(directory);
    for (const std::int64_t step : {0, 10, 20, 30}) write(file, step, &state(step));
  }
  {
    const RunDirectory directory(path(), ExistingRun::keep);
    ResultFile file = open(directory, {.continue_after = 15});
    EXPECT_EQ(file.frames(), 2);
    EXPECT_EQ(file.dropped_frames(), 2);
    EXPECT_EQ(write(file, 17, &state(17)), 2);
  }
  EXPECT_EQ(read_checkpoint(path(), 1).checkpoint.step, 10);
  EXPECT_EQ(read_checkpoint(path(), 2).checkpoint.step, 17);
  EXPECT_THROW_WITH(read_checkpoint(path(), 3), FileError, "frames 0 to 2");
  const std::string xdmf = content(path() / "run.xdmf");
  EXPECT_NE(xdmf.find("run.h5:/steps/2/position"), xdmf.npos);
  EXPECT_EQ(xdmf.find("/steps/3/"), xdmf.npos);
}

TEST_F(Results, EpochsStandInFilesOfTheirOwnAndAreCountedThrough) {
  const auto names = [&] {
    std::vector<std::string> found;
    for (const auto& file : result_series(path())) found.push_back(file.filename().string());
    return found;
  };
  using Names = std::vector<std::string>;
  {
    const RunDirectory directory(path(), ExistingRun::refuse);
    for (const std::int64_t epoch : {0, 1, 2}) {
      ResultFile file = open(directory, {.epoch = epoch});
      for (const std::int64_t step : {0, 10}) {
        const Snapshot kept = state(20 * epoch + step);
        EXPECT_EQ(write(file, 20 * epoch + step, &kept), step / 10);
      }
    }
  }
  EXPECT_EQ(names(), (Names{"run.h5", "run.1.h5", "run.2.h5"}));
  EXPECT_EQ(read_checkpoint(path(), 3).checkpoint.step, 30);
  EXPECT_THROW_WITH(read_checkpoint(path(), 6), FileError, "frames 4 to 5");
  EXPECT_NE(content(path() / "run.xdmf").find("run.1.h5:/steps/1/position"), std::string::npos);
  EXPECT_NE(content(path() / "run.vtkhdf.series").find("\"run.2.vtkhdf\", \"time\": 4"),
            std::string::npos);
  EXPECT_NE(describe_file(path()).find("  5     step 50"), std::string::npos);
  {  // Later frames are removed.
    const RunDirectory directory(path(), ExistingRun::keep);
    ResultFile file = open(directory, {.epoch = 1, .continue_after = 20});
    EXPECT_EQ(file.frames(), 1);
    EXPECT_EQ(names(), (Names{"run.h5", "run.1.h5"}));
    EXPECT_EQ(write(file, 25), 1);
  }
  EXPECT_EQ(content(path() / "run.h5.series").find("run.2.h5"), std::string::npos);
  const RunDirectory directory(path(), ExistingRun::replace);
  EXPECT_EQ(names(), Names{});
  EXPECT_FALSE(std::filesystem::exists(path() / "run.h5.series"));
}

TEST_F(Results, ContinuationOfAnotherSceneIsRefused) {
  {
    const RunDirectory directory(path(), ExistingRun::refuse);
    ResultFile file = open(directory);
    write(file, 0);
  }
  const RunDirectory directory(path(), ExistingRun::keep);
  X_.resize(4 + 2);
  EXPECT_THROW_WITH(open(directory, {.continue_after = 0}), FileError, "bodies");
}

TEST_F(Results, ContinuationWithoutAFileBeginsOne) {
  const RunDirectory directory(path(), ExistingRun::keep);
  ResultFile file = open(directory, {.continue_after = 100});
  EXPECT_EQ(write(file, 110), 0);
}

TEST_F(Results, StateOfAFrameIsReadBackBitForBit) {
  const RunDirectory directory(path(), ExistingRun::refuse);
  ResultFile file =
      open(directory, {.precision = ResultOptions::Precision::float32, .compression = 9});
  write(file, 0);
  write(file, 4, &state(4));
  // The file is still open for writing, but it is readable.
  const ReadCheckpoint read = read_checkpoint(directory.result_file(), 1);
  EXPECT_EQ(read.checkpoint.state.hash(), state(4).hash());
  EXPECT_EQ(read.checkpoint.input, input_);
  EXPECT_EQ(read.checkpoint.time, 0.1 * 4);
  EXPECT_THROW_WITH(read_checkpoint(path(), 0), FileError, "last one with the state is 1");
}

TEST_F(Results, SummaryNamesBodiesFieldsAndFrames) {
  const RunDirectory directory(path(), ExistingRun::refuse);
  ResultFile file = open(directory, {.time_unit = "ps"});
  write(file, 0);
  write(file, 20, &state(20));
  const std::string text = describe_file(path()), version = build().version;
  for (const char* part :
       {"drop                     2 particles", "wall                     3 particles",
        "pressure                 float64  1 component, Pa",
        "step 20         time 2            ps  with state", version.c_str()})
    EXPECT_NE(text.find(part), text.npos) << part << " is missing in\n" << text;
  EXPECT_THROW(describe_file(path() / "absent.h5"), FileError);
}

/// Limits the size of files while the object lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t size) {
    old_action_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit now{size, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_action_);
  }

 private:
  rlimit old_{};
  void (*old_action_)(int) = nullptr;
};

TEST_F(Results, FullDiskIsReportedAndLeavesTheFramesBefore) {
  std::int64_t frames = 0;
  {
    const RunDirectory directory(path(), ExistingRun::refuse);
    ResultFile file = open(directory);
    const FileSizeLimit limit(200000);
    const auto fill = [&] {
      for (; frames < 10000; ++frames) write(file, frames, &state(frames));
    };
    EXPECT_THROW_WITH(fill(), FileError, "File too large");
  }
  ASSERT_GT(frames, 3);
  const std::int64_t last = frames - 1;
  EXPECT_EQ(read_checkpoint(path(), last).checkpoint.state.hash(), state(last).hash());
  EXPECT_THROW(read_checkpoint(path(), frames), FileError);
}

}  // namespace
}  // namespace meniscus::test_io_results
