// SPDX-License-Identifier: MIT
#include "job/child.hpp"

#include "base/stopwatch.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace abbe::job {
namespace {

constexpr std::size_t kept_bytes = 4096;
/// A child that was asked to end and does not is killed after this: because it took too long, or
/// because this process shall end soon itself.
constexpr double patience_s = 5, little_patience_s = 0.3;

double seconds(timeval const& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

enum class Said { Something, Nothing, ThatWasAll };
/// Waits up to 20 ms for messages.
Said read_some(int pipe, std::string& text) {
  pollfd waiting{pipe, POLLIN, 0};
  if (poll(&waiting, 1, 20) <= 0) return Said::Nothing;
  std::array<char, 4096> buffer;
  auto const count = read(pipe, buffer.data(), buffer.size());
  if (count <= 0) return count < 0 && errno == EINTR ? Said::Nothing : Said::ThatWasAll;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  if (text.size() > kept_bytes) text.erase(0, text.size() - kept_bytes);
  return Said::Something;
}

pid_t start(std::string const& program, std::vector<std::string> const& words, int messages) {
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (auto const& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, messages, 2);
  pid_t child = -1;
  int const failed =
      posix_spawn(&child, program.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  return failed ? -1 : child;
}

} // namespace

ChildResult run_child(std::string const& program, std::vector<std::string> const& words,
                      double limit_s, std::atomic<bool> const* stop) {
  ChildResult result;
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return result;
  Stopwatch const since;
  pid_t const child = start(program, words, pipe_ends[1]);
  close(pipe_ends[1]);
  if (child < 0) {
    close(pipe_ends[0]);
    return result;
  }
  bool open = true;
  double asked = 0; // when it was asked to end
  int status = 0;
  rusage usage{};
  for (;;) {
    if (open) open = read_some(pipe_ends[0], result.messages) != Said::ThatWasAll;
    pid_t const ended = wait4(child, &status, open ? WNOHANG : 0, &usage);
    if (ended == child || (ended < 0 && errno != EINTR)) break;
    double const now = since.wall_s();
    bool const late = limit_s > 0 && now > limit_s;
    bool const stopped = stop && stop->load();
    if (asked == 0 && (late || stopped)) {
      result.end = stopped ? ChildResult::End::Stopped : ChildResult::End::TimedOut;
      asked = now;
      kill(child, SIGTERM);
    } else if (asked > 0 && now - asked > (stopped ? little_patience_s : patience_s)) {
      kill(child, SIGKILL);
    }
  }
  // What it wrote last, all of it, is in the pipe.
  while (open) open = read_some(pipe_ends[0], result.messages) == Said::Something;
  close(pipe_ends[0]);
  result.wall_s = since.wall_s();
  result.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peak_mib = static_cast<double>(usage.ru_maxrss) / 1024;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (asked == 0)
    result.end = result.status == 0     ? ChildResult::End::Done
                 : stop && stop->load() ? ChildResult::End::Stopped
                                        : ChildResult::End::Failed;
  return result;
}

} // namespace abbe::job
