// `clusterbench completion SHELL` and `clusterbench man`: files that packages install beside the program.

#include <iostream>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/command_line/man_page.h"
#include "cli/completion/completion.h"
#include "run/findings/run_result.h"

namespace clusterbench::cli {
namespace {

std::string completion(const CommandNode& root, const std::string& shell) {
  if (shell == "bash") return bash_completion(root);
  return shell == "zsh" ? zsh_completion(root) : fish_completion(root);
}

}  // namespace

void add_completion(Command& program, Action& action) {
  Command command = program.add_command("completion", "Print the completion script of a shell");
  auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "The shell").required().one_of({"bash", "zsh", "fish"});
  command.when_named([shell, &program, &action] {
    action = [shell, &program] {
      std::cout << completion(command_tree(program), *shell);
      return ExitCode::ok;
    };
  });
}

void add_man(Command& program, Action& action) {
  Command command = program.add_command("man", "Print the manual page, in roff");
  command.when_named([&program, &action] {
    action = [&program] {
      std::cout << man_page(command_tree(program), run::tool_facts().version);
      return ExitCode::ok;
    };
  });
}

}  // namespace clusterbench::cli
