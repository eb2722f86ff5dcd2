// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The gnuplot subprocess.
#include "reports/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace isotach::reports {
namespace {

namespace fs = std::filesystem;

/// A folder of one's own, gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "isotach-figure-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error(fmt::format("cannot create a folder for figures like {}: {}", name,
                                           std::generic_category().message(errno)));
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void check(int error) {
  if (error != 0) {
    throw std::runtime_error(
        fmt::format("cannot start gnuplot, which draws the figures (package gnuplot-nox): {}",
                    std::generic_category().message(error)));
  }
}

/// Runs gnuplot on the script with its outputs into files, which cannot fill up as pipes do; the wait status.
int run(const std::string& script, const std::string& output, const std::string& errors) {
  posix_spawn_file_actions_t actions;
  check(posix_spawn_file_actions_init(&actions));
  const int create = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), create, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), create, 0600);
  std::string program = "gnuplot";
  std::string default_settings = "-d";
  std::string path = script;
  char* const arguments[] = {program.data(), default_settings.data(), path.data(), nullptr};
  pid_t child = -1;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  check(error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) check(errno);
  }
  return status;
}

}  // namespace

std::string run_gnuplot(std::string_view script) {
  const TemporaryFolder folder;
  const std::string script_path = folder.file("script.gp");
  std::ofstream file(script_path, std::ios::binary);
  file.write(script.data(), static_cast<std::streamsize>(script.size()));
  file.close();
  if (!file) throw std::runtime_error(fmt::format("cannot write {}", script_path));
  const std::string errors_path = folder.file("errors");
  const std::string output_path = folder.file("output");
  const int status = run(script_path, output_path, errors_path);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const std::string reason = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                                   : fmt::format("exit code {}", WEXITSTATUS(status));
    throw std::runtime_error(fmt::format("gnuplot failed ({}): {}", reason, content_of(errors_path)));
  }
  return content_of(output_path);
}

std::string gnuplot_quoted(std::string_view text) {
  // Inside single quotes gnuplot expands neither escapes nor macros nor backquotes; '' is one quote.
  std::string quoted = "'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\'') quoted += '\'';
    quoted += byte < 0x20 || byte == 0x7F ? ' ' : c;
  }
  return quoted + "'";
}

}  // namespace isotach::reports
