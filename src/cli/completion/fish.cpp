#include "cli/completion/completion.h"
#include "core/text.h"

namespace clusterbench::cli {
namespace {

using Kind = Values::Kind;

// Prints the command named by the words of the line so far.
std::string path_function(const std::vector<const CommandNode*>& commands) {
  std::string paths;
  for (const CommandNode* command : commands)
    if (!command->path.empty()) paths += " " + shell_word(command->path);
  return R"(# fish completion of clusterbench, written by `clusterbench completion fish`

function __clusterbench_at
  set -l path
  for word in (commandline -opc)[2..-1]
    set -l longer (string join -- ' ' $path $word)
    if contains -- $longer)" +
         paths + R"(
      set path $longer
    end
  end
  test "$path" = "$argv"
end

complete -c clusterbench -f
)";
}

std::string start(const CommandNode& command) {
  return "complete -c clusterbench -n " + shell_word("__clusterbench_at " + command.path);
}

std::string fish_option(const CommandNode& command, const OptionNode& option) {
  std::string line = start(command);
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.needs_value && !option.is_value_optional) line += " -r";
  if (option.values.kind == Kind::files) line += " -F";
  if (option.values.kind == Kind::words) line += " -f -a " + shell_word(joined(option.values.words, " "));
  if (option.values.kind == Kind::named_files)  // a file after the sign is completed like any word
    line += " -a " + shell_word(joined(option.values.words, "= ") + "=");
  return line + " -d " + shell_word(first_sentence(option.description)) + "\n";
}

std::string argument_line(const CommandNode& command, const ArgumentNode& argument) {
  if (argument.values.kind == Kind::files) return start(command) + " -F\n";
  if (argument.values.kind == Kind::free) return "";
  return start(command) + " -a " + shell_word(joined(argument.values.words, " ")) + "\n";
}

}  // namespace

std::string fish_completion(const CommandNode& root) {
  const std::vector<const CommandNode*> commands = all_commands(root);
  std::string text = path_function(commands);
  for (const CommandNode* command : commands) {
    text += "\n";
    for (const CommandNode& below : command->commands)
      text += start(*command) + " -a " + below.name + " -d " + shell_word(first_sentence(below.description)) + "\n";
    for (const OptionNode& option : command->options) text += fish_option(*command, option);
    for (const ArgumentNode& argument : command->arguments) text += argument_line(*command, argument);
  }
  return text;
}

}  // namespace clusterbench::cli
