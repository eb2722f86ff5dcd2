// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The built program, or one that starts it, as a child process: started, signalled, waited for, its output
// read.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace isotach::consumer {

/// The whole file; empty where there is none.
inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// How a process ended.
struct Ended {
  int code;  ///< exit code; -1 if a signal ended it
  std::string out;
  std::string err;
};

/// `COMMAND...`, a program and its arguments, started in `folder`. Its output goes to the files `streams`.out
/// and .err.
class Process {
 public:
  Process(std::vector<std::string> command, const std::filesystem::path& folder,
          std::filesystem::path streams)
      : streams_(std::move(streams)) {
    std::vector<char*> argv;
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = streams_.string() + ".out";
    const std::string err = streams_.string() + ".err";
    child_ = fork();
    if (child_ < 0) throw std::runtime_error("cannot fork");
    if (child_ == 0) {
      const bool ready = chdir(folder.c_str()) == 0 && std::freopen(out.c_str(), "w", stdout) != nullptr &&
                         std::freopen(err.c_str(), "w", stderr) != nullptr;
      if (ready) execv(argv[0], argv.data());
      _exit(127);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }

  [[nodiscard]] pid_t id() const { return child_; }
  void signal(int number) const { kill(child_, number); }

  Ended wait() {
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(streams_.string() + ".out"),
            content_of(streams_.string() + ".err")};
  }

 private:
  std::filesystem::path streams_;
  pid_t child_ = -1;
};

}  // namespace isotach::consumer
