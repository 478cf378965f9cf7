// SPDX-License-Identifier: MIT
#include "job/child.hpp"
#include "job/interrupt.hpp"

#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

/// What a job has to do with processes and signals.
namespace abbe::job {
namespace {

using End = ChildResult::End;

ChildResult shell(char const* script, std::atomic<bool> const* stop = nullptr, double limit_s = 0) {
  return run_child("/bin/sh", {"-c", script}, limit_s, stop);
}

TEST(Children, TellHowTheyEnded) {
  auto const done = shell("echo hello >&2; echo not this");
  EXPECT_EQ(done.end, End::Done);
  EXPECT_EQ(done.status, 0);
  EXPECT_EQ(done.messages, "hello\n");
  EXPECT_GT(done.wall_s, 0);
  EXPECT_GT(done.peak_mib, 0);
  auto const failed = shell("echo why >&2; exit 3");
  EXPECT_EQ(failed.end, End::Failed);
  EXPECT_EQ(failed.status, 3);
  EXPECT_EQ(failed.messages, "why\n");
  EXPECT_EQ(shell("kill -KILL $$").status, 128 + SIGKILL);
  EXPECT_EQ(run_child("/no/such/program", {}, 0, nullptr).end, End::NotStarted);
}

TEST(Children, KeepTheEndOfWhatTheySay) {
  auto const said = shell("for i in $(seq 1 3000); do echo $i; done >&2").messages;
  EXPECT_LE(said.size(), 4096u);
  EXPECT_THAT(said, ::testing::EndsWith("2999\n3000\n"));
}

TEST(Children, AreAskedToEnd) {
  std::atomic<bool> const stop = true;
  EXPECT_EQ(shell("exec sleep 1000", &stop).end, End::Stopped);
  EXPECT_EQ(shell("exec sleep 1000", nullptr, 0.01).end, End::TimedOut);
}

TEST(InterruptsDeathTest, SetAFlag) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        bool const before = interrupted();
        std::raise(SIGTERM);
        _exit(!before && interrupted() ? 5 : 6);
      },
      ::testing::ExitedWithCode(5), "");
}

TEST(InterruptsDeathTest, EndTheProcessTheSecondTime) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        std::raise(SIGINT);
        std::raise(SIGINT);
      },
      ::testing::ExitedWithCode(130), "");
}

} // namespace
} // namespace abbe::job
