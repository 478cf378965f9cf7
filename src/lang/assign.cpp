// SPDX-License-Identifier: MIT
// Values behind `=` and as macro arguments, and where they go.
#include "lang/arrays.hpp"
#include "lang/function.hpp"
#include "lang/interpreter.hpp"
#include "lang/spline.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

constexpr std::string_view colour_words[] = {"color", "colour", "rgb",   "rgbf",   "rgbt",
                                             "rgbft", "srgb",   "srgbf", "srgbt",  "srgbft",
                                             "red",   "green",  "blue",  "filter", "transmit"};

Value colour_value(scene::Colour const& colour) {
  Value value;
  if (colour.spectrum) {
    value.any = colour;
    return value;
  }
  Numeric n;
  n.size = 5;
  n.colour = true;
  n.c = {colour.rgb.x, colour.rgb.y, colour.rgb.z, colour.filter, colour.transmit};
  value.any = n;
  return value;
}

} // namespace

/// `White filter .5`: keywords that set components of the colour read so far.
Value ReaderImpl::finish_colour(Numeric n) {
  if (n.size == 5) n.colour = true;
  Value value;
  while (n.size == 5 && next() == Next::Word) {
    constexpr std::string_view parts[] = {"red", "green", "blue", "filter", "transmit"};
    auto const part = std::find(std::begin(parts), std::end(parts), peek_.word);
    if (part == std::end(parts)) break;
    consume();
    n.c[static_cast<std::size_t>(part - parts)] = number(*part);
  }
  value.any = n;
  return value;
}

Value ReaderImpl::block_value(ast::Block const& block) {
  open_block(block.items, block.span, block.head.text);
  Value value;
  if (block.head.text == "spline") {
    value.any = read_spline(*this);
  } else if (BlockKind const* const kind = find_block_kind(block.head.text)) {
    value = kind->read(*this, block.head.text);
  } else {
    in_.error("E0202",
              fmt::format("'{}' is no kind of block that can be a value{}", block.head.text,
                          in_.suggestion(block.head.text)),
              block.span);
    while (next() != Next::End) skip();
  }
  close();
  return value;
}

Value ReaderImpl::read_value() {
  Value value;
  switch (next()) {
  case Next::Numeric: {
    Numeric const n = evaluate_peeked();
    consume();
    return finish_colour(n);
  }
  case Next::String:
    value.any = string("a string");
    return value;
  case Next::Identifier:
    comma_ = comma_behind(peek_.span);
    value = copy_of(*peek_.value);
    take();
    break;
  case Next::Block: {
    ast::Block const& block = *peek_.block;
    consume();
    value = block_value(block);
    comma_ = comma_behind(block.span);
    break;
  }
  case Next::Word:
    if (std::find(std::begin(colour_words), std::end(colour_words), peek_.word)
        != std::end(colour_words)) {
      if (auto const colour = accept_colour(*this)) return colour_value(*colour);
      return value;
    }
    [[fallthrough]];
  default:
    missing("a value", "a number, a string, a block or the name of one");
    return value;
  }
  // A layered texture is several blocks in a row, with no comma between.
  using LayersPtr = std::shared_ptr<scene::Layers const>;
  while (std::holds_alternative<LayersPtr>(value.any) && next() == Next::Block
         && peek_.block->head.text == "texture" && !comma_) {
    ast::Block const& block = *peek_.block;
    consume();
    Value const layer = block_value(block);
    auto layers = std::make_shared<scene::Layers>(*std::get<LayersPtr>(value.any));
    if (auto const* more = std::get_if<LayersPtr>(&layer.any))
      layers->insert(layers->end(), (*more)->begin(), (*more)->end());
    value.any = LayersPtr(std::move(layers));
    comma_ = comma_behind(block.span);
  }
  return value;
}

Value ReaderImpl::value_of(ast::Items const& items, Span span) {
  if (ast::Expr const* const only = Expressions::sole(items)) {
    // The frequent kinds without a frame.
    if (ast::get_if<ast::Number>(*only) || ast::get_if<ast::LiteralVector>(*only)
        || ast::get_if<ast::Vector>(*only) || ast::get_if<ast::Unary>(*only)
        || ast::get_if<ast::Member>(*only)) {
      Value value;
      Numeric n = in_.expressions.numeric(*only);
      if (n.size == 5) n.colour = true;
      value.any = n;
      return value;
    }
    if (auto const* binary = ast::get_if<ast::Binary>(*only)) {
      if (auto scaled = in_.expressions.spectral_product(*binary)) return *scaled;
      Value value;
      Numeric n = in_.expressions(*binary);
      if (n.size == 5) n.colour = true;
      value.any = n;
      return value;
    }
  }
  enter_region(items, span);
  Value value = read_value();
  leave_region();
  return value;
}

Value ReaderImpl::macro_value(ast::Call const& call, MacroValue const& macro) {
  static ast::Items const nothing;
  enter_region(nothing, call.span);
  push_macro(call, macro);
  Value value;
  if (next() == Next::End)
    in_.error("E0307",
              fmt::format("macro '{}' yields nothing where a value is needed", call.callee.text),
              call.span);
  else
    value = read_value();
  leave_region();
  return value;
}

/// By reference when it is one name or one element of an array, else by value.
Scope::Cell ReaderImpl::argument(ast::Items const& items, Span span) {
  if (ast::Expr const* const only = Expressions::sole(items)) {
    if (auto const* name = ast::get_if<ast::Name>(*only); name && !name->reserved) {
      auto cell = in_.scope.cell(in_.scope.symbol(*name));
      bool const there = cell && !cell->empty();
      if (there && std::holds_alternative<std::shared_ptr<FunctionValue>>(cell->any))
        return std::make_shared<Value>(*cell);
      if (there) return cell;
      in_.expressions.undeclared(*name);
      cell = std::make_shared<Value>();
      cell->any = poison();
      return cell;
    }
    if (auto const* index = ast::get_if<ast::Index>(*only)) {
      auto cell = in_.expressions.element_cell(*index);
      if (!cell) {
        cell = std::make_shared<Value>();
        cell->any = poison();
      }
      return cell;
    }
  }
  Deferral deferral(in_);
  auto const cell = std::make_shared<Value>(value_of(items, span));
  cell->deferred = deferral.take();
  return cell;
}

void ReaderImpl::push_macro(ast::Call const& call, MacroValue const& value) {
  ast::Macro const& macro = *value.tree;
  bool const none = call.arguments.size() == 1 && call.arguments.front().empty();
  std::size_t const given = none ? 0 : call.arguments.size();
  if (given != macro.parameters.size()) {
    in_.report(Severity::Error, "E0308",
               fmt::format("macro '{}' takes {} argument{}, not {}", macro.name.text,
                           macro.parameters.size(), macro.parameters.size() == 1 ? "" : "s", given),
               call.span, {{macro.name.span, "defined here"}});
    return;
  }
  if (macros_ >= in_.options().max_macro_depth) {
    in_.error("E0703",
              fmt::format("macro calls nest deeper than {}: endless recursion?",
                          in_.options().max_macro_depth),
              call.span);
    in_.abort();
  }
  std::vector<Scope::Cell> cells(given);
  for (std::size_t i = 0; i < given; ++i) cells[i] = argument(call.arguments[i], call.span);
  in_.check_limits(call.span);
  in_.scope.enter();
  ++macros_;
  for (std::size_t i = 0; i < given; ++i)
    in_.scope.bind(in_.scope.symbol(macro.parameters[i]), std::move(cells[i]));
  Frame frame;
  frame.items = &macro.body;
  frame.kind = Frame::Kind::Macro;
  frame.span = call.span;
  frame.name = macro.name.text;
  push(std::move(frame));
}

void ReaderImpl::assign(ast::Declare const& declare, Value&& value) {
  if (value.empty()) value.any = poison();
  value.declared_at = declare.span;
  if (auto const* index = ast::get_if<ast::Index>(declare.target)) {
    auto const array = in_.expressions.array_of(*index);
    Value* const element = array ? in_.expressions.element(*index) : nullptr;
    if (!element) return;
    if (!array->admit(value)) {
      in_.error("E0312",
                fmt::format("array '{}' holds {} per element, not {}", index->array.text,
                            array->type_text, type_name(value)),
                declare.span);
      return;
    }
    *element = std::move(value);
    return;
  }
  auto const* name = ast::get_if<ast::Name>(declare.target);
  if (!name || name->reserved) {
    in_.error("E0204", "only a name that is not reserved can be declared",
              ast::span_of(declare.target));
    return;
  }
  Symbol const symbol = in_.scope.symbol(*name);
  Value& slot = declare.local ? in_.scope.declare_local(symbol) : in_.scope.declare(symbol);
  if (std::holds_alternative<std::shared_ptr<FunctionValue>>(slot.any)) {
    in_.report(Severity::Error, "E0205",
               fmt::format("function '{0}' is declared already: '#undef {0}' first", name->text),
               name->span, {{slot.declared_at, "declared here"}});
    return;
  }
  slot = std::move(value);
  if (declare.deprecated)
    in_.scope.deprecate(symbol, {declare.deprecation.span.valid()
                                     ? declare.deprecation.text
                                     : fmt::format("'{}' is deprecated", name->text),
                                 declare.deprecated_once});
}

} // namespace abbe::lang
