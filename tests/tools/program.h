// Runs a built program as a user would: arguments in, exit code and output back.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace octolux::test {

struct Outcome {
  int exit_code = -1;  // -1: ended by a signal
  std::string out;     // stdout
  std::string err;     // stderr
};

inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The program running in `folder`, with a pipe-less stdout and stderr (two files there).
class Program {
 public:
  Program(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
          const std::string& program = OCTOLUX_PROGRAM)
      : out_(folder / ".out"), err_(folder / ".err") {
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), program);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    process_ = ::fork();
    if (process_ == 0) start(folder.path(), argv);
  }

  pid_t process() const { return process_; }

  Outcome wait() const {
    int status = 0;
    ::waitpid(process_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out_), read_file(err_)};
  }

 private:
  /// In the child: never returns.
  void start(const std::string& folder, const std::vector<char*>& argv) const {
    constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
    ::dup2(::open(out_.c_str(), kFlags, 0600), STDOUT_FILENO);
    ::dup2(::open(err_.c_str(), kFlags, 0600), STDERR_FILENO);
    ::unsetenv("OCIO");
    if (::chdir(folder.c_str()) == 0) ::execv(argv.front(), argv.data());
    ::_exit(127);
  }

  std::string out_, err_;
  pid_t process_;
};

inline Outcome run_program(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                           const std::string& program = OCTOLUX_PROGRAM) {
  return Program(folder, arguments, program).wait();
}

}  // namespace octolux::test
