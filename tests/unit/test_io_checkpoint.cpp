// SPDX-License-Identifier: BSD-3-Clause
// Snapshots, checkpoints, damaged files, SHA-256, command lines.
#include "input/sha256.hpp"
#include "io/checkpoint.hpp"
#include "io/info.hpp"
#include "meniscus/error.hpp"
#include "unit/io_helpers.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

namespace meniscus::test_io_checkpoint {
namespace {

TEST(Hash, IsFnv1a) {
  // Test vectors of the authors (Fowler, Noll, Vo).
  const auto hash = [](std::string_view text) {
    Fnv1a h;
    h.add(text);
    return h.value();
  };
  EXPECT_EQ(hash(""), 0xcbf29ce484222325u);
  EXPECT_EQ(hash("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hash("foobar"), 0x85944171f73967e8u);
}

TEST(Hash, Sha256IsThatOfTheStandard) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(SnapshotOfARun, HashSeesNamesTypesOrderOfNumbersAndSigns) {
  const auto hash = [](const std::string& name, std::vector<Real> values) {
    Snapshot s;
    s.add_reals(name, values, "m");
    return s.hash();
  };
  const auto h = hash("a", {1, 2, 0});
  EXPECT_NE(h, hash("b", {1, 2, 0}));
  EXPECT_NE(h, hash("a", {2, 1, 0}));
  EXPECT_NE(h, hash("a", {1, 2, -0.0}));
  EXPECT_NE(h, hash("a", {1, 2}));
  EXPECT_NE(h, hash("a", {1, std::nextafter(2.0, 3.0), 0}));
  Snapshot reals, integers;
  reals.add_reals("a", std::vector<Real>{0});
  integers.add_integers("a", std::vector<std::int64_t>{0});
  EXPECT_NE(reals.hash(), integers.hash());
}

TEST(SnapshotOfARun, HashDoesNotDependOnTheOrderOfAdding) {
  Snapshot ab, ba;
  ab.add_text("a", "1"), ab.add_text("b", "2");
  ba.add_text("b", "2"), ba.add_text("a", "1");
  EXPECT_EQ(ab.hash(), ba.hash());
}

TEST(SnapshotOfARun, WrongNamesTypesAndSizesAreNamed) {
  Snapshot s;
  s.add_reals("velocity", std::vector<Real>{1, 2, 3});
  std::vector<Real> four(4);
  EXPECT_THROW_WITH(s.reals("speed"), FileError, "it has: velocity");
  EXPECT_THROW_WITH(s.integers("velocity"), FileError, "array of integers");
  EXPECT_THROW_WITH(s.copy_to("velocity", four), FileError, "3 numbers where 4 are expected");
  EXPECT_THROW(s.real("velocity"), FileError);
}

class Checkpoints : public TemporaryDirectory {
 protected:
  Checkpoints() : directory_(path(), ExistingRun::refuse), writer_(writer()) {}

  CheckpointWriter writer() { return {directory_, provenance("test", "dimension = 2\n")}; }
  std::filesystem::path write(std::int64_t step) {
    return writer_.write(step, 0.1 * static_cast<Real>(step), state(step));
  }
  std::int64_t newest_step() { return read_checkpoint(path()).checkpoint.step; }

  RunDirectory directory_;
  CheckpointWriter writer_;
};

void flip_bit(const std::filesystem::path& file, std::streamoff position) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(position);
  const char byte = static_cast<char>(stream.get() ^ 1);
  stream.seekp(position);
  stream.put(byte);
}

TEST_F(Checkpoints, RoundTripIsBitwise) {
  const auto file = write(7);
  const ReadCheckpoint read = read_checkpoint(file);
  const Checkpoint& checkpoint = read.checkpoint;
  EXPECT_EQ(checkpoint.step, 7);
  EXPECT_EQ(checkpoint.time, 0.1 * 7);
  EXPECT_EQ(checkpoint.input, "dimension = 2\n");
  EXPECT_EQ(checkpoint.state.hash(), state(7).hash());
  ASSERT_EQ(checkpoint.state.arrays().size(), state(7).arrays().size());
  for (const auto& [name, array] : state(7).arrays()) {
    const auto& stored = checkpoint.state.arrays().at(name);
    EXPECT_EQ(stored.values, array.values) << name;
    EXPECT_EQ(stored.unit, array.unit) << name;
  }
  EXPECT_TRUE(std::signbit(checkpoint.state.reals("velocity")[1]));
  EXPECT_TRUE(read.warnings.empty());
}

TEST_F(Checkpoints, AlternateBetweenTwoFiles) {
  const auto a = write(1), b = write(2), c = write(3);
  EXPECT_NE(a, b);
  EXPECT_EQ(a, c);
  EXPECT_EQ(newest_step(), 3);
  EXPECT_EQ(read_checkpoint(b).checkpoint.step, 2);
}

TEST_F(Checkpoints, ANewWriterKeepsTheNewestAndCountsAsNewerWhateverItsStep) {
  const auto older = write(1), newest = write(50);
  writer_ = writer();
  EXPECT_EQ(write(20), older);  // continued from an earlier frame
  EXPECT_EQ(newest_step(), 20);
  EXPECT_EQ(read_checkpoint(newest).checkpoint.step, 50);
}

TEST_F(Checkpoints, EveryFlippedBitIsNoticedAndTheOtherFileTaken) {
  write(1);
  const auto newest = write(2);
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(newest));
  for (std::streamoff position = 0; position < size; position += 97) {
    flip_bit(newest, position);
    const ReadCheckpoint read = read_checkpoint(path());
    ASSERT_EQ(read.checkpoint.step, 1) << "bit at " << position;
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_NE(read.warnings[0].find(newest.string()), std::string::npos);
    EXPECT_THROW(read_checkpoint(newest), FileError);
    flip_bit(newest, position);
  }
  EXPECT_EQ(newest_step(), 2);
}

TEST_F(Checkpoints, ATruncatedFileIsPassedOverAndReplacedNext) {
  write(1);
  const auto newest = write(2);
  std::filesystem::resize_file(newest, std::filesystem::file_size(newest) - 1);
  EXPECT_EQ(newest_step(), 1);
  writer_ = writer();
  EXPECT_EQ(write(3), newest);
  EXPECT_EQ(newest_step(), 3);
}

TEST_F(Checkpoints, BothDamagedIsAnError) {
  std::filesystem::resize_file(write(1), 100);
  std::filesystem::resize_file(write(2), 5000);
  EXPECT_THROW_WITH(read_checkpoint(path()), FileError, "is damaged");
}

TEST_F(Checkpoints, NoneIsAnError) {
  EXPECT_THROW_WITH(read_checkpoint(path()), FileError, "there is none");
  EXPECT_THROW_WITH(read_checkpoint(path() / "checkpoint-a.h5"), FileError, "cannot read");
}

TEST_F(Checkpoints, AStateThatIsNotFiniteIsRefusedAndTheLastOneStays) {
  write(1);
  Snapshot bad;
  bad.add_reals("force", std::vector<Real>{1, std::numeric_limits<Real>::infinity()}, "N");
  EXPECT_THROW_WITH(writer_.write(2, 0.2, bad), SolveError, "'force' is inf at entry 1");
  EXPECT_EQ(newest_step(), 1);
}

TEST_F(Checkpoints, SummaryNamesTheArrays) {
  const std::string text = describe_file(write(7));
  for (const char* part : {"step      7", "controller/phase", "velocity                 float64"})
    EXPECT_NE(text.find(part), text.npos) << part << " is missing in\n" << text;
}

TEST(ProvenanceOfARun, CommandLineDoesNotTellWhereFilesAre) {
  const char* argv[] = {"/usr/local/bin/meniscus", "run",   "/home/me/drop.toml",
                        "--output=/a/b/",          "--set", "end='1/2 ps'"};
  EXPECT_EQ(portable_command_line(6, argv), "meniscus run drop.toml --output=b --set end='1/2 ps'");
}

}  // namespace
}  // namespace meniscus::test_io_checkpoint
