// SPDX-License-Identifier: MIT
#include "cli/command_line.hpp"

#include "cli/hints.hpp"
#include "cli/say.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <fmt/format.h>

namespace abbe::cli {
namespace {

CLI::Option* of(void* option) {
  return static_cast<CLI::Option*>(option);
}

} // namespace

Option& Option::required() {
  of(option_)->required();
  return *this;
}
Option& Option::type_name(std::string name) {
  of(option_)->type_name(std::move(name));
  return *this;
}
Option& Option::range(int least, int most) {
  of(option_)->check(CLI::Range(least, most));
  return *this;
}
Option& Option::range(double least, double most) {
  of(option_)->check(CLI::Range(least, most));
  return *this;
}
Option& Option::positive() {
  of(option_)->check(CLI::PositiveNumber);
  return *this;
}
Option& Option::one_of(std::initializer_list<char const*> words) {
  of(option_)->check(CLI::IsMember(std::vector<std::string>(words.begin(), words.end())));
  return *this;
}
Option& Option::check(Check check) {
  of(option_)->check(std::move(check));
  return *this;
}
Option& Option::show_default() {
  of(option_)->capture_default_str();
  return *this;
}
Option& Option::separated_by(char separator) {
  of(option_)->delimiter(separator);
  return *this;
}
Option& Option::one_at_a_time() {
  of(option_)->allow_extra_args(false);
  return *this;
}
Option& Option::needs(Option const& other) {
  of(option_)->needs(of(other.option_));
  return *this;
}
Option& Option::excludes(Option const& other) {
  of(option_)->excludes(of(other.option_));
  return *this;
}
Option& Option::excludes(std::string const& name) {
  of(option_)->excludes(name);
  return *this;
}

struct CommandLine::Impl {
  CLI::App* app;
  std::unique_ptr<CLI::App> own; ///< null for a part of another
  std::vector<std::unique_ptr<CommandLine>> parts;

  CommandLine& add_part(CLI::App* part) {
    std::unique_ptr<Impl> impl(new Impl{part, nullptr, {}});
    return *parts.emplace_back(new CommandLine(std::move(impl)));
  }
};

CommandLine::CommandLine(std::string description, std::string name)
    : impl_(new Impl{
        nullptr, std::make_unique<CLI::App>(std::move(description), std::move(name)), {}}) {
  impl_->app = impl_->own.get();
}
CommandLine::CommandLine(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CommandLine::~CommandLine() = default;

template <class Target>
Option CommandLine::add_option(std::string const& names, Target& target, std::string const& help) {
  return Option(impl_->app->add_option(names, target, help));
}
template Option CommandLine::add_option(std::string const&, int&, std::string const&);
template Option CommandLine::add_option(std::string const&, double&, std::string const&);
template Option CommandLine::add_option(std::string const&, std::uint64_t&, std::string const&);
template Option CommandLine::add_option(std::string const&, std::string&, std::string const&);
template Option CommandLine::add_option(std::string const&, std::optional<int>&,
                                        std::string const&);
template Option CommandLine::add_option(std::string const&, std::optional<double>&,
                                        std::string const&);
template Option CommandLine::add_option(std::string const&, std::vector<int>&, std::string const&);
template Option CommandLine::add_option(std::string const&, std::vector<double>&,
                                        std::string const&);
template Option CommandLine::add_option(std::string const&, std::vector<std::string>&,
                                        std::string const&);
Option CommandLine::add_flag(std::string const& names, bool& target, std::string const& help) {
  return Option(impl_->app->add_flag(names, target, help));
}

CommandLine& CommandLine::add_choice(std::string const& name) {
  auto* const group = impl_->app->add_option_group(name);
  group->require_option(1);
  return impl_->add_part(group);
}
CommandLine& CommandLine::add_subcommand(std::string const& name, std::string const& help) {
  impl_->app->require_subcommand(1);
  return impl_->add_part(impl_->app->add_subcommand(name, help));
}
void CommandLine::footer(std::string text) {
  impl_->app->footer(std::move(text));
}
void CommandLine::keep_letters_free() {
  impl_->app->set_help_flag("--help", "print this help and exit");
}

int CommandLine::parse(int argc, char** argv) {
  try {
    impl_->app->parse(argc, argv);
  } catch (CLI::ParseError const& stop) {
    if (impl_->app->exit(stop) == 0) return 0;
    for (int i = 1; i < argc; ++i)
      if (auto const hint = hint_of_word(argv[i]); !hint.empty())
        say("{}: {}\n", impl_->app->get_name(), hint);
    return 2;
  }
  return -1;
}
bool CommandLine::has(std::string const& name) const {
  return impl_->app->count(name) > 0;
}
bool CommandLine::is_chosen() const {
  return impl_->app->parsed();
}

} // namespace abbe::cli
