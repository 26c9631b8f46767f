#include "src/io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "src/core/errors.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::bytesOf;
using tests::messageOf;
using tests::TempFolder;
using tests::writeBytes;

std::span<const std::byte> bytes(const std::string& text) {
  return std::as_bytes(std::span(text));
}

// A process number that is not in use: that of a child that has ended.
pid_t endedProcess() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  int status = 0;
  ::waitpid(child, &status, 0);
  return child;
}

TEST(AtomicFile, AppearsWholeOnCommitAndNotBefore) {
  const TempFolder folder;
  AtomicFile file(folder / "a.txt");
  file.write(bytes("one "));
  file.write(bytes("two"));
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  file.commit();
  EXPECT_EQ(bytesOf(folder / "a.txt"), "one two");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, ReplacesAnOlderFileOnlyOnCommit) {
  const TempFolder folder;
  writeBytes(folder / "a.txt", "old");
  {
    AtomicFile file(folder / "a.txt");
    file.write(bytes("new"));
    EXPECT_EQ(bytesOf(folder / "a.txt"), "old");
  }
  EXPECT_EQ(bytesOf(folder / "a.txt"), "old");
  writeFileAtomically(folder / "a.txt", bytes("new"));
  EXPECT_EQ(bytesOf(folder / "a.txt"), "new");
}

TEST(AtomicFile, LeavesNothingWhenAnExceptionEndsTheWriting) {
  const TempFolder folder;
  EXPECT_THROW(
      {
        AtomicFile file(folder / "a.txt");
        file.write(bytes("half"));
        throw std::runtime_error("interrupted");
      },
      std::runtime_error);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(AtomicFile, KilledLeavesATemporaryThatIsRecognisedAndCleared) {
  const TempFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    AtomicFile file(folder / "000007.exr");
    file.write(bytes("half a frame"));
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(fs::exists(folder / "000007.exr"));
  ASSERT_EQ(folder.names().size(), 1U);
  EXPECT_TRUE(isTemporaryName(folder.names().front()));
  EXPECT_EQ(removeLeftoverTemporaries(folder.path()), 1);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(AtomicFile, LeftoversOfRunningProcessesAndFilesOfOthersStay) {
  const TempFolder folder;
  // Process 1 always runs.
  writeBytes(folder / ".a.exr.1-0.promenade-tmp", "");
  writeBytes(folder / (".b.exr." + std::to_string(endedProcess()) + "-0.promenade-tmp"), "");
  writeBytes(folder / ".c.exr.promenade-tmp", "");
  writeBytes(folder / "d.exr", "");
  EXPECT_EQ(removeLeftoverTemporaries(folder.path()), 1);
  EXPECT_THAT(folder.names(),
              testing::UnorderedElementsAre(".a.exr.1-0.promenade-tmp", ".c.exr.promenade-tmp", "d.exr"));
}

TEST(AtomicFile, NothingIsLeftOverInAFolderThatDoesNotExist) {
  const TempFolder folder;
  EXPECT_EQ(removeLeftoverTemporaries(folder / "absent"), 0);
}

TEST(AtomicFile, TwoWritersOfOneFileDoNotMix) {
  const TempFolder folder;
  AtomicFile first(folder / "a.txt");
  AtomicFile second(folder / "a.txt");
  EXPECT_NE(first.temporaryPath(), second.temporaryPath());
  first.write(bytes("first"));
  second.write(bytes("second"));
  first.commit();
  second.commit();
  EXPECT_EQ(bytesOf(folder / "a.txt"), "second");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, RefusesAFolderThatDoesNotExist) {
  const TempFolder folder;
  EXPECT_THAT(messageOf<InputError>([&] { AtomicFile(folder / "absent/a.txt"); }),
              HasSubstr("absent/a.txt: cannot create the file: No such file or directory"));
  writeBytes(folder / "file", "");
  EXPECT_THAT(messageOf<InputError>([&] { AtomicFile(folder / "file/a.txt"); }),
              HasSubstr("Not a directory"));
}

TEST(AtomicFile, RefusesAFolderThatMayNotBeWritten) {
  const TempFolder folder;
  fs::create_directory(folder / "locked");
  fs::permissions(folder.path(), fs::perms::all);
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                         fs::perms::others_exec);
  // The superuser may write everywhere, so become somebody else for a moment.
  const bool superuser = ::geteuid() == 0;
  if (superuser) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  const std::string message = messageOf<InputError>([&] { AtomicFile(folder / "locked/a.txt"); });
  if (superuser) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_THAT(message, HasSubstr("Permission denied"));
}

TEST(AtomicFile, RefusesWhatIsNotTheNameOfAFile) {
  const TempFolder folder;
  EXPECT_THAT(messageOf<InputError>([&] { AtomicFile(folder.path()); }), HasSubstr("found a folder"));
  EXPECT_THAT(messageOf<InputError>([&] { AtomicFile("/dev/full"); }), HasSubstr("not a regular file"));
  EXPECT_THROW(AtomicFile(""), InputError);
  EXPECT_THROW(AtomicFile(folder / std::string(300, 'a')), InputError);
}

TEST(AtomicFile, WritesThroughALink) {
  const TempFolder folder;
  writeBytes(folder / "target", "old");
  fs::create_symlink(folder / "target", folder / "link");
  writeFileAtomically(folder / "link", bytes("new"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(bytesOf(folder / "target"), "new");
}

}  // namespace
}  // namespace promenade::io
