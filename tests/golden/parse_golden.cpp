// SPDX-License-Identifier: MIT
#include "base/diagnostic.hpp"
#include "golden.hpp"
#include "grammar/parse.hpp"

int main(int argc, char** argv) {
  return abbe::golden::run(argc, argv, [](std::string const& name, std::string text) {
    abbe::SourceFile const source(name, std::move(text));
    abbe::Parsed const parsed = abbe::parse(source);
    if (parsed.errors.empty()) return abbe::dump_ast(parsed.document);
    std::string out;
    for (auto const& error : parsed.errors) out += abbe::format(error) + '\n';
    return out;
  });
}
