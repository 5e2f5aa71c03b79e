// `clusterbench completion SHELL` and `clusterbench man`: what packages install beside the program.

#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/completion/completion.h"
#include "cli/man_page.h"
#include "run/result.h"

namespace clusterbench::cli {
namespace {

std::string completion(const CommandNode& root, const std::string& shell) {
  if (shell == "bash") return bash_completion(root);
  return shell == "zsh" ? zsh_completion(root) : fish_completion(root);
}

}  // namespace

void add_completion(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("completion", "Print the completion script of a shell");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "The shell")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->callback([shell, &app, &action] {
    action = [shell, &app] {
      std::cout << completion(command_tree(app), *shell);
      return ExitCode::ok;
    };
  });
}

void add_man(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("man", "Print the manual page, in roff");
  command->callback([&app, &action] {
    action = [&app] {
      std::cout << man_page(command_tree(app), run::tool_facts().version);
      return ExitCode::ok;
    };
  });
}

}  // namespace clusterbench::cli
