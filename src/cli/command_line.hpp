// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The command line of a subcommand. The only door to CLI11, whose headers take longer to compile
/// than all that a subcommand does.
namespace abbe::cli {

/// An option of a CommandLine, which owns it: says more about it, call by call.
class Option {
public:
  /// Returns the fault of a text; an empty one means that there is none.
  using Check = std::function<std::string(std::string const&)>;

  explicit Option(void* option) : option_(option) {}

  Option& required();
  Option& type_name(std::string name);
  /// The number lies between `least` and `most`.
  Option& range(int least, int most);
  Option& range(double least, double most);
  Option& positive();
  /// The text is one of `words`.
  Option& one_of(std::initializer_list<char const*> words);
  Option& check(Check check);
  /// The help shows the value that the target holds now.
  Option& show_default();
  /// Several values are separated by this.
  Option& separated_by(char separator);
  /// The option takes one value each time that it is given.
  Option& one_at_a_time();
  Option& needs(Option const& other);
  Option& excludes(Option const& other);
  Option& excludes(std::string const& name);

private:
  void* option_;
};

/// Targets are written when the command line is parsed.
class CommandLine {
public:
  /// @param name what the program calls itself: "abbe render"
  CommandLine(std::string description, std::string name);
  ~CommandLine();
  CommandLine(CommandLine const&) = delete;
  CommandLine& operator=(CommandLine const&) = delete;

  /// @param names "-o,--output", or "FILE" for a word by its place
  /// @tparam Target int, double, std::uint64_t, std::string, std::optional<int or double>, or a
  /// vector of
  ///         int, double or std::string
  template <class Target>
  Option add_option(std::string const& names, Target& target, std::string const& help);
  Option add_flag(std::string const& names, bool& target, std::string const& help);

  /// Just one of the flags that are added to what this returns has to be given.
  CommandLine& add_choice(std::string const& name);
  /// A word that stands before options of its own; one of them has to be given.
  CommandLine& add_subcommand(std::string const& name, std::string const& help);
  void footer(std::string text);
  /// Only --help asks for help, no single letter does.
  void keep_letters_free();

  /// Prints help or what is wrong. @return -1 to go on, else the exit status
  int parse(int argc, char** argv);
  /// After parse: was the option given, was this subcommand?
  bool has(std::string const& name) const;
  bool is_chosen() const;

private:
  struct Impl;
  explicit CommandLine(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

} // namespace abbe::cli
