// SPDX-License-Identifier: MIT
// Directives that are a word and its arguments: includes, messages, files, #version, #default,
// #undef.
#include "lang/interpreter.hpp"

#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

constexpr int max_include_depth = 64;

} // namespace

void ReaderImpl::include(ast::Directive const& node) {
  enter_region(node.arguments, node.span);
  int const errors = in_.error_count();
  std::string const name = path("the name of a file");
  leave_region();
  if (in_.error_count() > errors) return;
  if (includes_ >= max_include_depth) {
    in_.error(
        "E0704",
        fmt::format("includes nest deeper than {}: does a file include itself?", max_include_depth),
        node.span);
    in_.abort();
  }
  auto const sources = in_.files.include(name, node.span);
  for (auto source = sources.rbegin(); source != sources.rend(); ++source)
    push_include(**source, node);
}

void ReaderImpl::push_include(SourceFile const& source, ast::Directive const& node) {
  in_.scope.enter();
  ++includes_;
  static ast::Items const nothing;
  Frame frame;
  frame.items = &nothing;
  frame.kind = Frame::Kind::Include;
  frame.span = node.span;
  frame.name = source.name();
  push(std::move(frame));
  if (StatementStream* const stream = in_.streams.open(source)) {
    frames_.back().items = &stream->statements;
    read_from(stream);
    return;
  }
  int const before = in_.error_count();
  frames_.back().items = &in_.document(source).items;
  if (in_.error_count() > before) in_.abort();
}

void ReaderImpl::message(ast::Directive const& node) {
  std::string text;
  if (!node.arguments.empty() || node.word == "error") {
    enter_region(node.arguments, node.span);
    text = string("the text of the message");
    if (upcoming() != nullptr) fall(); // `#debug S -1`: the sign belongs to what follows
    leave_region();
  }
  if (node.word == "warning") {
    in_.warning(std::move(text), node.span);
  } else if (node.word == "error") {
    in_.error("", std::move(text), node.span);
    in_.abort();
  } else {
    in_.say(text);
  }
}

void ReaderImpl::set_version(ast::Directive const& node) {
  enter_region(node.arguments, node.span);
  double const version = number("the version of the language");
  leave_region();
  if (version < 1 || version >= 4) {
    in_.error("E0322", fmt::format("there is no version {} of the language", version), node.span);
    return;
  }
  in_.version = version;
  in_.state.effective_version = version;
  in_.state.default_noise_generator = version < 3.5 ? 1 : 2;
}

void ReaderImpl::set_default(ast::Directive const& node) {
  enter_region(node.arguments, node.span);
  if (open_any()) {
    read_default(*this);
    close();
  } else {
    missing("the new defaults", "{ ... }");
  }
  leave_region();
}

void ReaderImpl::undefine(ast::Directive const& node) {
  ast::Expr const* const target = Expressions::sole(node.arguments);
  if (target) {
    if (auto const* name = ast::get_if<ast::Name>(*target); name && !name->reserved) {
      Symbol const symbol = in_.scope.symbol(*name);
      in_.scope.forget_deprecation(symbol);
      if (!in_.scope.undefine(symbol))
        in_.warning(fmt::format("#undef: '{}' is not declared", name->text), node.span);
      return;
    }
    if (auto const* index = ast::get_if<ast::Index>(*target)) {
      if (Value* const element = in_.expressions.element(*index)) element->any = std::monostate{};
      return;
    }
  }
  in_.error("E0206", "expected a name or an element of an array", node.span);
}

// -------------------------------------------------------------------------------------- files

void ReaderImpl::open_file(ast::Directive const& node) {
  auto const* name = node.arguments.empty() ? nullptr : ast::get_if<ast::Name>(node.arguments[0]);
  if (!name || name->reserved) {
    in_.error("E0206", "expected the name of a file handle", node.span);
    return;
  }
  Symbol const symbol = in_.scope.symbol(*name);
  enter_region(node.arguments, node.span);
  frames_.back().position = 1; // behind the handle
  SourceFile const* const from = node.span.source;
  int const errors = in_.error_count();
  std::string const file = path("the name of a file");
  auto opened = [&]() -> Result<std::shared_ptr<FileValue>> {
    if (in_.error_count() > errors) return std::shared_ptr<FileValue>();
    if (accept("read")) return in_.files.open_read(file, from);
    if (accept("write")) return in_.files.open_write(file, false, node.span);
    if (accept("append")) return in_.files.open_write(file, true, node.span);
    unexpected("read, write or append");
    return std::shared_ptr<FileValue>();
  }();
  leave_region();
  if (!opened) {
    in_.error(opened.error().code, opened.error().message, node.span);
    return;
  }
  if (!*opened) return;
  Value& slot = in_.scope.declare(symbol);
  slot.any = *opened;
  slot.declared_at = name->span;
}

std::shared_ptr<FileValue> ReaderImpl::file_handle(ast::Directive const& node, Symbol& symbol) {
  auto const* name = node.arguments.empty() ? nullptr : ast::get_if<ast::Name>(node.arguments[0]);
  symbol = name && !name->reserved ? in_.scope.symbol(*name) : 0;
  Value const* const value = symbol ? in_.scope.find(symbol) : nullptr;
  auto const* file = value ? std::get_if<std::shared_ptr<FileValue>>(&value->any) : nullptr;
  if (file) return *file;
  in_.error("E0505",
            name ? fmt::format("'{}' is no open file", name->text) : "expected a file handle",
            name ? name->span : node.span);
  return nullptr;
}

void ReaderImpl::close_file(ast::Directive const& node) {
  Symbol symbol = 0;
  if (auto const* name = ast::get_if<ast::Name>(node.arguments.at(0)); name && !name->reserved) {
    symbol = in_.scope.symbol(*name);
    Value const* const value = in_.scope.find(symbol);
    if (value == nullptr || !std::holds_alternative<std::shared_ptr<FileValue>>(value->any)) {
      // Reading the last value has closed it, or another #fclose.
      if (!closed_files_.contains(symbol))
        in_.warning(fmt::format("#fclose: '{}' is no open file", name->text), node.span);
      return;
    }
  }
  if (file_handle(node, symbol)) close_handle(symbol);
}

void ReaderImpl::close_handle(Symbol symbol) {
  in_.scope.undefine(symbol);
  closed_files_.insert(symbol);
}

/// `#read(H, a, b)`: literals of the file into names; the handle is closed behind the last literal.
void ReaderImpl::read_file(ast::Directive const& node) {
  Symbol symbol = 0;
  auto const file = file_handle(node, symbol);
  if (!file) return;
  if (file->writing) {
    in_.error("E0505", "the file is open for writing", node.span);
    return;
  }
  for (std::size_t i = 1; i < node.arguments.size(); ++i) {
    auto value = read_literal(*file);
    if (!value) {
      in_.error(value.error().code, value.error().message, ast::span_of(node.arguments[i]));
      return;
    }
    if (value->empty()) break;
    value->declared_at = node.span;
    if (auto const* name = ast::get_if<ast::Name>(node.arguments[i]); name && !name->reserved) {
      in_.scope.declare(in_.scope.symbol(*name)) = std::move(*value);
    } else if (auto const* index = ast::get_if<ast::Index>(node.arguments[i])) {
      if (Value* const element = in_.expressions.element(*index)) *element = std::move(*value);
    } else {
      in_.error("E0206", "expected a name or an element of an array",
                ast::span_of(node.arguments[i]));
      return;
    }
  }
  if (at_end_of_literals(*file)) close_handle(symbol);
}

void ReaderImpl::write_file(ast::Directive const& node) {
  Symbol symbol = 0;
  auto const file = file_handle(node, symbol);
  if (!file) return;
  if (!file->writing) {
    in_.error("E0505", "the file is open for reading", node.span);
    return;
  }
  enter_region(node.arguments, node.span);
  frames_.back().position = 1; // behind the handle
  BinaryForm form = BinaryForm::None;
  std::string text;
  while (!at_end()) {
    switch (next()) {
    case Next::String:
      text += string("a text");
      break;
    case Next::Numeric: {
      Span const span = peek_.span;
      Numeric const n = numeric("a value", 1);
      if (form == BinaryForm::None)
        text += write_text(n);
      else if (n.size == 1)
        text += write_binary(n.scalar(), form);
      else
        in_.error("E0302", "only floats can be written in a binary form", span);
      break;
    }
    case Next::Word:
      if (auto const found = binary_form(peek_.word)) {
        form = *found;
        consume();
        break;
      }
      [[fallthrough]];
    default:
      unexpected("a number or a string to write");
    }
  }
  leave_region();
  in_.files.write(*file, text);
}

} // namespace abbe::lang
