// SPDX-License-Identifier: MIT
#include "lang/statement_streams.hpp"

#include "lang/interpreter.hpp"

#include <utility>

namespace abbe::lang {

StatementStream* StatementStreams::open(SourceFile const& source) {
  // What is read again and again is better kept.
  if (source.text().size() <= in_.options().whole_text || !seen_.insert(&source).second)
    return nullptr;
  auto stream = std::make_unique<StatementStream>(source);
  stream->mark = in_.mark();
  stream->chain = in_.reader.chain();
  streams_.push_back(std::move(stream));
  next(*streams_.back());
  return streams_.back().get();
}

bool StatementStreams::next(StatementStream& stream) {
  if (stream.parser.at_end()) return false;
  // A block that an #if left open is still being read.
  keep(stream.before, stream.before_lasting || in_.reader.in_loose_block());
  stream.before.swap(stream.statements);
  stream.before_lasting = stream.lasting;
  stream.lasting = false;
  do {
    auto piece = stream.parser.next(in_.options().text_piece, stream.statements);
    stream.lasting |= piece.lasting;
    if (piece.errors.empty()) continue;
    auto more = rest_of(stream);
    piece.errors.insert(piece.errors.end(), std::make_move_iterator(more.begin()),
                        std::make_move_iterator(more.end()));
    report_syntax(std::move(piece.errors));
    in_.abort();
  } while (stream.statements.empty() && !stream.parser.at_end());
  return !stream.statements.empty();
}

void StatementStreams::close() {
  StatementStream& stream = *streams_.back();
  if (auto errors = rest_of(stream); !errors.empty()) {
    report_syntax(std::move(errors));
    in_.abort();
  }
  keep(stream.before, stream.before_lasting);
  keep(stream.statements, stream.lasting);
  streams_.pop_back();
  if (none()) in_.release_messages();
}

void StatementStreams::abandon() {
  while (!none()) {
    auto errors = in_.stopped() ? std::vector<Diagnostic>() : rest_of(*streams_.back());
    try {
      if (errors.empty())
        streams_.pop_back();
      else
        report_syntax(std::move(errors));
    } catch (Aborted const&) { // too many of them: said
    }
  }
  in_.release_messages();
}

std::vector<Diagnostic> StatementStreams::rest_of(StatementStream& stream) {
  std::vector<Diagnostic> errors;
  ast::Items ignored;
  while (!stream.parser.at_end()) {
    auto piece = stream.parser.next(in_.options().text_piece, ignored);
    errors.insert(errors.end(), std::make_move_iterator(piece.errors.begin()),
                  std::make_move_iterator(piece.errors.end()));
  }
  return errors;
}

/// Of the innermost stream, which ends here.
void StatementStreams::report_syntax(std::vector<Diagnostic> errors) {
  auto const stream = std::move(streams_.back());
  streams_.pop_back();
  in_.roll_back(stream->mark);
  for (auto& error : errors) {
    error.notes.insert(error.notes.end(), stream->chain.begin(), stream->chain.end());
    in_.add(std::move(error));
  }
}

void StatementStreams::keep(ast::Items& statements, bool lasting) {
  if (lasting) kept_.push_back(std::move(statements));
  statements.clear();
}

} // namespace abbe::lang
