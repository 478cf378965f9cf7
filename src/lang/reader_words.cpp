// SPDX-License-Identifier: MIT
// The reader's words, and what to say when they are wrong.
#include "lang/attach.hpp"
#include "lang/function_field.hpp"
#include "lang/interpreter.hpp"

#include <fmt/format.h>

namespace abbe::lang {

std::string_view ReaderImpl::next_word() {
  switch (next()) {
  case Next::Word:
  case Next::Block:
    return peek_.word;
  default:
    return {};
  }
}

bool ReaderImpl::accept(std::string_view word) {
  next();
  std::string_view found;
  if (peek_.next == Next::Word) {
    found = peek_.word;
  } else if ((peek_.next == Next::Numeric || peek_.next == Next::Identifier
              || peek_.next == Next::String)
             && peek_.expr && !peek_.split) {
    // A word of abbe's is no reserved one: the user may have declared it. Who asks for it, gets it.
    if (auto const* name = ast::get_if<ast::Name>(*peek_.expr)) found = name->text;
  }
  if (found == word) {
    consume();
    return true;
  }
  ask(word);
  return false;
}

bool ReaderImpl::has_number() {
  if (next() != Next::Numeric) return false;
  // A vector is told by how it is written; an expression is not evaluated twice (it may call rand).
  return !peek_.expr
         || (!ast::get_if<ast::LiteralVector>(*peek_.expr)
             && !ast::get_if<ast::Vector>(*peek_.expr));
}

std::vector<double> ReaderImpl::call(std::string_view word, std::size_t count) {
  bool const value = next() == Next::Numeric;
  auto const* const call =
      value && peek_.expr && !peek_.split ? ast::get_if<ast::Call>(*peek_.expr) : nullptr;
  if (call == nullptr || call->callee.text != word) {
    ask(word);
    return {};
  }
  Span const at = call->span;
  std::vector<double> values;
  for (ast::Items const& argument : call->arguments) {
    ast::Expr const* const only = Expressions::sole(argument);
    values.push_back(only ? in_.expressions.scalar(*only, fmt::format("argument of {}", word)) : 0);
  }
  consume();
  take_punctuation(':'); // `xyz(1, 0, 0): 2`
  if (values.size() == count) return values;
  report(Severity::Error, "E0316",
         fmt::format("{} takes {} numbers, not {}", word, count, values.size()), at);
  values.resize(count);
  return values;
}

std::optional<bool> ReaderImpl::flag(std::string_view word) {
  if (!accept(word)) return std::nullopt;
  return boolean_or(true);
}

bool ReaderImpl::take_punctuation(char symbol) {
  if (next() != Next::Punctuation || peek_.symbol != symbol) return false;
  consume();
  return true;
}

int ReaderImpl::face_texture() {
  // `texture_list { A B C }` names them bare, elsewhere they stand in a block.
  if (auto named = accept_value<scene::Layers>()) return add_face_texture(named.get(), *named);
  if (next() != Next::Block || peek_.word != "texture") {
    ask("texture");
    return -1;
  }
  open_any();
  Value const* const value = identifier();
  auto const* held =
      value ? std::get_if<std::shared_ptr<scene::Layers const>>(&value->any) : nullptr;
  void const* const key = held ? held->get() : nullptr;
  scene::SharedLayers const layers = read_texture(*this);
  // Only a block that is the bare name stands for the declared texture itself.
  Frame const& frame = frames_.back();
  bool const bare = key && frame.kind == Frame::Kind::Block && frame.items->size() == 1;
  close();
  return add_face_texture(bare ? key : nullptr, *layers);
}

bool ReaderImpl::part_modifier(std::vector<AffineMap>& steps, int& texture) {
  auto const own = [&]() -> scene::Layers& {
    return face_textures_[static_cast<std::size_t>(texture)];
  };
  geometry::Transform t;
  if (read_transform(*this, t)) {
    steps.push_back({t.linear, t.inverse_linear, t.linear_error, t.inverse_linear_error, t.offset,
                     t.inverse_offset, t.offset_error, t.inverse_offset_error});
    if (texture >= 0) transform_layers(own(), t);
    return true;
  }
  scene::SharedLayers layers, inner;
  std::shared_ptr<scene::Interior const> interior;
  if (texture >= 0) layers = own();
  Span const at = next_span();
  if (!read_surface(*this, {layers, inner, interior})) return false;
  if (inner || interior)
    report(Severity::Error, "E0621", "an interior belongs to the object, not to a part of it", at);
  if (!layers) return true;
  if (texture < 0)
    texture = add_face_texture(nullptr, std::move(*layers));
  else
    own() = std::move(*layers);
  return true;
}

std::shared_ptr<ScalarField const> ReaderImpl::field() {
  Value const* const value = identifier();
  auto const* held = value ? std::get_if<std::shared_ptr<FunctionValue>>(&value->any) : nullptr;
  if (!held) {
    auto const* number =
        next() == Next::Numeric && peek_.value ? std::get_if<Numeric>(&peek_.value->any) : nullptr;
    if (number && number->poisoned()) // reported
      take();
    else
      report(Severity::Error, "E0629", "expected function { ... } of x, y and z", next_span());
    return nullptr;
  }
  std::shared_ptr<FunctionValue const> const function = *held;
  Span const at = next_span();
  take();
  if (!function->unsupported.empty()) {
    report(Severity::Error, "E0901", function->unsupported, at);
    return nullptr;
  }
  if (function->vector) {
    report(Severity::Error, "E0622", "a function of numbers is wanted, not of vectors or colours",
           at);
    return nullptr;
  }
  if (function->parameters != 3) {
    report(Severity::Error, "E0622",
           fmt::format("a function of x, y and z is wanted, not one of {} arguments",
                       function->parameters),
           at);
    return nullptr;
  }
  return std::make_shared<FunctionField>(function);
}

int ReaderImpl::add_face_texture(void const* declared, scene::Layers layers) {
  if (declared) {
    auto const [found, fresh] =
        face_texture_index_.try_emplace(declared, static_cast<int>(face_textures_.size()));
    if (!fresh) return found->second;
  }
  face_textures_.push_back(std::move(layers));
  return static_cast<int>(face_textures_.size()) - 1;
}

std::vector<scene::Layers> ReaderImpl::take_face_textures() {
  face_texture_index_.clear();
  return std::exchange(face_textures_, {});
}

// ------------------------------------------------------------------------------------- errors

void ReaderImpl::report(Severity severity, std::string_view code, std::string_view message,
                        Span span) {
  // Values, optics, geometry: of a block with a stand-in for a wrong value, nothing more is said.
  bool const about_values =
      code.substr(0, 3) == "E03" || code.substr(0, 3) == "E04" || code.substr(0, 3) == "E06";
  if (about_values && tainted()) return;
  std::string text(message);
  // Said of a name that is none: it is done with, and what follows of it is not said.
  bool const of_name = severity == Severity::Error && peek_.ready && peek_.next == Next::Word
                       && peek_.undeclared && span.valid() && span.begin == peek_.span.begin;
  if (of_name) {
    std::string const hint = in_.files.include_hint(peek_.word);
    text += hint.empty() ? did_you_mean(peek_.word, asked_) : hint;
  }
  in_.report(severity, code, text, span.valid() ? span : block_span());
  if (!of_name) return;
  taint();
  skip();
}

void ReaderImpl::unexpected(std::string_view what) {
  // What stands for something reported before is not reported again.
  if (next() == Next::Numeric && peek_.value) {
    auto const* const number = std::get_if<Numeric>(&peek_.value->any);
    if (number && number->poisoned()) return skip();
  }
  // What is not supported yet is told as such, wherever it stands.
  Value const* const value = identifier();
  if (value && std::holds_alternative<Unsupported>(value->any)) return take();
  Span span = next_span();
  bool const name = peek_.next == Next::Word && peek_.undeclared;
  bool const loose = in_open_block();
  if (tainted() && (loose || (!name && peek_.next != Next::Block))) return skip();
  bool const block = peek_.next == Next::Block && !peek_.word.empty();
  std::string_view const word = next_word();
  std::vector<Diagnostic::Note> notes;
  if (loose)
    notes.push_back({open_blocks_.back().span, fmt::format("in this '{}', which the text it stands "
                                                           "in does not close",
                                                           open_blocks_.back().head)});
  if (name || (block && !find_block_kind(word))) {
    std::string const hint = in_.suggestion(word, asked_);
    if (block && peek_.block->head.span.valid()) span = peek_.block->head.span;
    in_.report(
        Severity::Error, "E0202",
        fmt::format("unknown {} '{}': expected {}{}", name ? "name" : "block", word, what, hint),
        span, std::move(notes));
  } else {
    std::string const hint = word.empty() ? std::string() : did_you_mean(word, asked_);
    in_.report(Severity::Error, "E0203",
               fmt::format("expected {}, found {}{}", what, describe_next(), hint), span,
               std::move(notes));
  }
  if (loose) taint();
  skip();
}

void ReaderImpl::skip() {
  bool const word = next() == Next::Word;
  if (peek_.next == Next::Block && (peek_.block->open || frames_.back().tail != nullptr)) {
    open_any();
    while (next() != Next::End) skip();
    return close();
  }
  consume();
  if (!word) return;
  for (;;) {
    Next const n = next();
    bool const belongs = n == Next::Numeric || n == Next::String || n == Next::Bracket
                         || (n == Next::Block && peek_.word.empty());
    if (!belongs) return;
    consume();
  }
}

} // namespace abbe::lang
