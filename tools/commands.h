// The verbs of the command line. A verb is one command_NAME.cpp, one maker here and one line in
// main.cpp.
#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace octolux {

class Command {
 public:
  virtual ~Command() = default;
  /// Was this verb typed? Valid after the arguments were parsed.
  virtual bool chosen() const = 0;
  /// Does the work; returns the exit code. Throws Error for bad input.
  virtual int run() = 0;
};

/// Each adds its verb and options to `app`, which must outlive the command. `command_line` is what
/// the user typed, for the record in the picture.
std::unique_ptr<Command> make_render_command(CLI::App& app, const std::string& command_line);
std::unique_ptr<Command> make_info_command(CLI::App& app);
std::unique_ptr<Command> make_lab_command(CLI::App& app);
std::unique_ptr<Command> make_compare_command(CLI::App& app);
std::unique_ptr<Command> make_ab_command(CLI::App& app, const std::string& command_line);
std::unique_ptr<Command> make_converge_command(CLI::App& app, const std::string& command_line);

}  // namespace octolux
