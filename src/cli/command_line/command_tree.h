#pragma once
// The command line as data: input of completions and the manual page. Read from the parser itself, so that a new option
// is in all of them.

#include <string>
#include <vector>

#include "cli/command_line/command.h"

namespace clusterbench::cli {

// Possible values of an option or an argument.
struct Values {
  enum class Kind {
    free,         // a number, a pattern: no suggestions
    files,        // the shell's own completion
    words,        // one of `words`
    named_files,  // one of `words`, an equals sign and a file
  };
  Kind kind = Kind::free;
  std::vector<std::string> words;
};

struct OptionNode {
  std::vector<std::string> names;  // "-o", "--output"
  std::string description;
  bool needs_value = false, is_value_optional = false;  // an optional value needs an equals sign
  bool is_repeatable = false;
  Values values;
};

struct ArgumentNode {
  std::string name, description;
  bool is_repeatable = false, is_required = false;
  Values values;
};

struct CommandNode {
  std::string path;  // "scene generate"; "" for the program itself
  std::string name, description, footer;
  std::vector<OptionNode> options;
  std::vector<ArgumentNode> arguments;
  std::vector<CommandNode> commands;
};

// Includes the options that the help leaves out.
CommandNode command_tree(const Command& program);

// The program and all commands below it; a parent comes before its children.
std::vector<const CommandNode*> all_commands(const CommandNode& root);

// "FILE", "FORMAT=FILE", or the option's name in capitals.
std::string placeholder(const OptionNode& option);

}  // namespace clusterbench::cli
