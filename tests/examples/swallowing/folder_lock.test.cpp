// SPDX-License-Identifier: MIT
#include "../common/folder_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"

namespace folder_lock_test {

using examples::FolderLock;
using hmps_test::message_of;
using hmps_test::TemporaryFolder;

TEST(FolderLock, ExcludesASecondRun) {
  const TemporaryFolder folder;
  const auto refusal = [&] { return message_of<hmps::InputError>([&] { (void)FolderLock(folder.path()); }); };
  {
    const FolderLock lock(folder.path());
    for (const std::string& part : {folder.path().string(), std::to_string(::getpid()), std::string("--out")})
      EXPECT_NE(refusal().find(part), std::string::npos) << refusal();
  }
  EXPECT_EQ(refusal(), "");
}

TEST(FolderLock, EndsWithItsProcess) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const FolderLock lock(folder.path());
    examples::write_atomically(folder.path() / "locked", "");
    for (;;) ::pause();
  }
  while (!std::filesystem::exists(folder.path() / "locked")) ::usleep(500);
  EXPECT_NE(message_of<hmps::InputError>([&] { (void)FolderLock(folder.path()); }).find(std::to_string(child)),
            std::string::npos);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW((void)FolderLock(folder.path(), FolderLock::Taken::wait));
}

TEST(FolderLock, ReportsThatItWaits) {
  const TemporaryFolder folder;
  const auto words = folder.path() / "words";
  std::optional<FolderLock> lock(folder.path());
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    lock.reset();  // the copy of the child, which does not give up that of the parent
    if (std::freopen(words.c_str(), "w", stderr) == nullptr) ::_exit(1);
    { const FolderLock other(folder.path(), FolderLock::Taken::wait); }
    ::_exit(0);
  }
  const auto said = [&] { return std::filesystem::exists(words) ? examples::read_file(words) : std::string(); };
  int status = 0;
  while (said().find("waiting") == std::string::npos && ::waitpid(child, &status, WNOHANG) == 0) ::usleep(500);
  EXPECT_NE(said().find(std::to_string(::getpid())), std::string::npos) << said();
  lock.reset();
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(FolderLock, NeedsAFolder) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)FolderLock(folder.path() / "none"), hmps::InputError);
}

}  // namespace folder_lock_test
