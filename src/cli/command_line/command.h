#pragma once
// A command of the command line, with its options. The parser itself (CLI11) is hidden behind it: its header is large,
// and all commands together would take minutes to build.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class Option;
}  // namespace CLI

namespace clusterbench::cli {

// As in configurations: any reader of JSON keeps it.
inline constexpr std::uint64_t k_most_seed = (std::uint64_t{1} << 53) - 1;

class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  Option& hidden();          // from the help
  Option& shows_standard();  // the value before parsing, in the help
  Option& range(int least, int most);
  Option& range(double least, double most);
  Option& at_least(std::uint64_t least);
  Option& seed();  // 0 to k_most_seed; shows the value before parsing
  Option& positive();
  Option& positive_to(double most);
  Option& non_negative();
  Option& one_of(std::vector<std::string> words);
  Option& once_a_name();  // --name A --name B, not --name A B
  Option& utf8();         // for text that gets into JSON; names of files may have any bytes
  Option& needs(const Option& other);

 private:
  CLI::Option* option_;
};

// Variables that receive option values must live as long as the parser.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}

  Command add_command(const std::string& name, const std::string& summary);
  // An option with a value ("-o,--output"), or an argument ("FILE").
  Option add_option(const std::string& names, std::string& value, const std::string& summary);
  Option add_option(const std::string& names, std::vector<std::string>& values, const std::string& summary);
  Option add_option(const std::string& names, int& value, const std::string& summary);
  Option add_option(const std::string& names, std::uint64_t& value, const std::string& summary);
  Option add_option(const std::string& names, double& value, const std::string& summary);
  Option add_flag(const std::string& names, bool& is_set, const std::string& summary);
  // "--count{auto}": the value in braces is used if none is given.
  Option add_flag(const std::string& names, std::string& value, const std::string& summary);
  void needs_command();
  void footer(const std::string& text);
  // Called after parsing if the user names this command.
  void when_named(std::function<void()> call);

  const CLI::App& parser() const { return *app_; }

 private:
  CLI::App* app_;
};

}  // namespace clusterbench::cli
