// SPDX-License-Identifier: MIT
// Values behind `=` and as macro arguments, and where they go.
#include "lang/arrays.hpp"
#include "lang/function.hpp"
#include "lang/interpreter.hpp"
#include "lang/pasted.hpp"
#include "lang/spline.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

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

bool ReaderImpl::goes_on(bool walled, Next kind, std::string_view word) {
  if (walled) return next() == kind && peek_.word == word;
  ast::Item const* const item = upcoming();
  if (item == nullptr) return false;
  if (auto const* const found = ast::get_if<ast::Word>(*item))
    return kind == Next::Word && found->text == word;
  auto const* const block = ast::get_if<ast::Block>(*item);
  return kind == Next::Block && block != nullptr && block->head.text == word;
}

/// `White filter .5`: keywords that set components of the colour read so far.
Value ReaderImpl::finish_colour(Numeric n, bool walled, Span at) {
  if (n.size == 5) n.colour = true;
  Value value;
  while (n.size == 5 && !(walled ? comma_follows(at) : comma_behind(at))) {
    constexpr std::string_view parts[] = {"red", "green", "blue", "filter", "transmit"};
    auto const part = std::find_if(std::begin(parts), std::end(parts), [&](std::string_view word) {
      return goes_on(walled, Next::Word, word);
    });
    if (part == std::end(parts)) break;
    consume();
    at = value_span();
    n.c[static_cast<std::size_t>(part - parts)] = number(*part);
  }
  value.any = n;
  return value;
}

Value ReaderImpl::block_value(ast::Block const& block) {
  open_block(block.items, block.span, block.head.text);
  return opened_value(block.head.text, block.span);
}

/// The value of the block that was opened, to its end.
Value ReaderImpl::opened_value(std::string_view head, Span span) {
  Value value;
  if (head == "spline") {
    value.any = read_spline(*this);
  } else if (BlockKind const* const kind = find_block_kind(head)) {
    value = kind->read(*this, head);
  } else {
    in_.error(
        "E0202",
        fmt::format("'{}' is no kind of block that can be a value{}", head, in_.suggestion(head)),
        span);
    while (next() != Next::End) skip();
  }
  close();
  return value;
}

Value ReaderImpl::read_value(bool walled) {
  Value value;
  switch (next()) {
  case Next::Numeric: {
    Span const at = value_span();
    Numeric const n = evaluate_peeked();
    consume();
    return finish_colour(n, walled, at);
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
    std::string_view const head = peek_.word;
    Span const span = peek_.span;
    open_any();
    value = opened_value(head, span);
    comma_ = comma_behind(span);
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
  while (std::holds_alternative<LayersPtr>(value.any) && goes_on(walled, Next::Block, "texture")
         && !comma_) { // which goes_on() may find behind a macro's end
    Span const span = next_span();
    open_any();
    Value const layer = opened_value("texture", span);
    auto layers = std::make_shared<scene::Layers>(*std::get<LayersPtr>(value.any));
    if (auto const* more = std::get_if<LayersPtr>(&layer.any))
      layers->insert(layers->end(), (*more)->begin(), (*more)->end());
    value.any = LayersPtr(std::move(layers));
    comma_ = comma_behind(span);
  }
  return value;
}

/// The value of the frequent kinds, for which no frame is needed; nullopt for all others.
std::optional<Value> ReaderImpl::simple_value(ast::Items const& items) {
  ast::Expr const* const only = Expressions::sole(items);
  if (only == nullptr) return std::nullopt;
  Numeric n;
  if (auto const* binary = ast::get_if<ast::Binary>(*only)) {
    if (auto scaled = in_.expressions.spectral_product(*binary)) return scaled;
    n = in_.expressions(*binary);
  } else if (ast::get_if<ast::Number>(*only) || ast::get_if<ast::LiteralVector>(*only)
             || ast::get_if<ast::Vector>(*only) || ast::get_if<ast::Unary>(*only)
             || ast::get_if<ast::Member>(*only)) {
    n = in_.expressions.numeric(*only);
  } else {
    return std::nullopt;
  }
  if (n.size == 5) n.colour = true;
  Value value;
  value.any = n;
  return value;
}

Value ReaderImpl::value_of(ast::Items const& items, Span span) {
  if (auto simple = simple_value(items)) return std::move(*simple);
  enter_region(items, span);
  Value value = read_value();
  leave_region();
  return value;
}

Value ReaderImpl::declared_value(ast::Declare const& node) {
  if (node.value.empty()) return read_value(false);
  if (auto simple = simple_value(node.value)) return std::move(*simple);
  enter_region(node.value, node.span, true);
  Value value = read_value();
  // What else a macro yields are the next statements.
  if (!entered_.back().fallen && frames_.back().kind != Frame::Kind::Region
      && upcoming() != nullptr)
    fall();
  leave_region();
  return value;
}

/// What the name of the target stands for before the value is read: that may go on behind the end
/// of the macro which the directive stands in, or end inside one that it calls.
ReaderImpl::Target ReaderImpl::target_of(ast::Declare const& node) {
  Target target{in_.scope.depth(), nullptr};
  auto const* name = ast::get_if<ast::Name>(node.target);
  if (name != nullptr && !node.local) target.cell = in_.scope.cell(in_.scope.symbol(*name));
  return target;
}

void ReaderImpl::execute(ast::Declare const& there) {
  // Of a large source, the tree of the directive may be gone when the value that follows is read.
  std::optional<ast::Declare> copy;
  if (there.value.empty()) copy = there;
  ast::Declare const& node = copy ? *copy : there;
  bool semicolon = node.has_semicolon;
  Target const target = target_of(node);
  Value value;
  {
    Deferral deferral(in_);
    value = declared_value(node);
    value.deferred = deferral.take();
  }
  auto const* const number = std::get_if<Numeric>(&value.any);
  bool const needs_semicolon = number != nullptr && !number->poisoned();
  assign(node, target, std::move(value));
  // The ';' may come next, in another text, or once more.
  ast::Item const* const item = upcoming();
  auto const* const mark = item != nullptr ? ast::get_if<ast::Punctuation>(*item) : nullptr;
  if (mark != nullptr && mark->symbol == ';') {
    next();
    consume();
    semicolon = true;
  }
  if (!needs_semicolon || semicolon) return;
  Span const place{node.span.source, node.span.end, node.span.end};
  constexpr std::string_view text = "a ';' is missing after this declaration of a number";
  if (in_.version < 3.5)
    in_.warning(std::string(text), place);
  else
    in_.error("E0105", std::string(text), place);
}

void ReaderImpl::yields_nothing(ast::Call const& call) {
  in_.error("E0307",
            fmt::format("macro '{}' yields nothing where a value is needed", call.callee.text),
            call.span);
}

Value ReaderImpl::macro_value(ast::Call const& call, MacroValue const& macro) {
  static ast::Items const nothing;
  enter_region(nothing, call.span);
  push_macro(call, macro);
  Value value;
  if (next() == Next::End)
    yields_nothing(call);
  else
    value = read_value();
  leave_region();
  return value;
}

void ReaderImpl::paste(ast::Call const& call, MacroValue const& macro, Pasted& into) {
  static ast::Items const nothing;
  enter_region(nothing, call.span);
  push_macro(call, macro);
  ast::Expr const* const expr = next() == Next::Numeric && peek_.value == nullptr
                                        && peek_.split == nullptr && peek_.rest == nullptr
                                    ? peek_.expr
                                    : nullptr;
  if (peek_.next == Next::End) {
    yields_nothing(call);
    into.add(Value{}, call.span);
  } else if (expr != nullptr) {
    into.add_open(*expr);
    consume();
  } else {
    into.add(read_value(), call.span);
  }
  leave_region();
}

/// The cell of a name or of an element of an array, which a parameter shares; else null.
Scope::Cell ReaderImpl::shared_cell(ast::Expr const& expr) {
  Scope::Cell cell;
  if (auto const* name = ast::get_if<ast::Name>(expr); name && !name->reserved) {
    cell = in_.scope.cell(in_.scope.symbol(*name));
    bool const there = cell && !cell->empty();
    if (there && std::holds_alternative<std::shared_ptr<FunctionValue>>(cell->any))
      return std::make_shared<Value>(*cell);
    if (there) return cell;
    in_.expressions.undeclared(*name);
    cell = nullptr;
  } else if (auto const* index = ast::get_if<ast::Index>(expr)) {
    cell = in_.expressions.element_cell(*index);
  } else {
    return nullptr;
  }
  if (!cell) {
    cell = std::make_shared<Value>();
    cell->any = poison();
  }
  return cell;
}

/// By reference when it is one name or one element of an array, else by value.
Scope::Cell ReaderImpl::argument(ast::Items const& items, Span span) {
  if (ast::Expr const* const only = Expressions::sole(items))
    if (auto cell = shared_cell(*only)) return cell;
  Deferral deferral(in_);
  auto const cell = std::make_shared<Value>(value_of(items, span));
  cell->deferred = deferral.take();
  return cell;
}

/// The arguments as they follow one another: commas between them are optional.
/// @return how many there are; nullopt when one is wrong (reported)
std::optional<std::size_t> ReaderImpl::arguments_in_a_row(ast::Call const& call,
                                                          std::vector<Scope::Cell>& cells) {
  static ast::Items const nothing;
  enter_region(nothing, call.span);
  for (auto items = call.arguments.rbegin(); items != call.arguments.rend(); ++items) {
    Frame frame;
    frame.items = &*items;
    push(std::move(frame));
  }
  std::size_t count = 0;
  bool good = true;
  while (good && !at_end()) {
    bool const whole = (peek_.next == Next::Numeric || peek_.next == Next::String
                        || peek_.next == Next::Identifier)
                       && peek_.expr != nullptr && !peek_.rest && !peek_.split;
    Scope::Cell cell = whole ? shared_cell(*peek_.expr) : nullptr;
    if (cell) {
      consume();
    } else {
      Deferral deferral(in_);
      cell = std::make_shared<Value>(read_value());
      cell->deferred = deferral.take();
    }
    good = !cell->empty();
    if (count < cells.size()) cells[count] = std::move(cell);
    ++count;
  }
  while (!at_end()) skip();
  leave_region();
  return good ? std::optional(count) : std::nullopt;
}

void ReaderImpl::push_macro(ast::Call const& call, MacroValue const& value) {
  ast::Macro const& macro = *value.tree;
  bool const none = call.arguments.size() == 1 && call.arguments.front().empty();
  std::size_t given = none ? 0 : call.arguments.size();
  std::vector<Scope::Cell> cells(macro.parameters.size());
  bool const in_a_row = given != 0 && given != cells.size();
  if (in_a_row) {
    auto const count = arguments_in_a_row(call, cells);
    if (!count) return;
    given = *count;
  }
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
  for (std::size_t i = 0; i < given && !in_a_row; ++i)
    cells[i] = argument(call.arguments[i], call.span);
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

void ReaderImpl::assign(ast::Declare const& declare, Target const& target, Value&& value) {
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
  bool const moved = target.cell != nullptr && in_.scope.depth() != target.depth;
  Value& slot = declare.local
                    ? in_.scope.declare_local(symbol, std::min(target.depth, in_.scope.depth()))
                : moved ? *target.cell
                        : in_.scope.declare(symbol);
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
