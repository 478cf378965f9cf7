// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/body.hpp"
#include "grammar/directive.hpp"
#include "grammar/expression.hpp"
#include "grammar/item.hpp"
#include "grammar/open_blocks.hpp"
#include "grammar/repeat_info.hpp"

namespace abbe::grammar::rules {

struct WhileId : tag_span {};
struct ForId : tag_span {};
struct SwitchId : tag_span {};
struct ClauseId : tag_span {};
struct IfId : tag_span {};
struct BranchId : tag_span {};
struct MoreId : tag_span {};

using Test = ast::If::Branch::Test;
using Kind = ast::Switch::Clause::Kind;

// ------------------------------------------------------------------------------------------- #if
x3::rule<struct ConditionId, ast::Expr> const condition = "'('";
auto const condition_def = paren;
x3::rule<struct NamedConditionId, ast::Expr> const named_condition = "'('";
auto const named_condition_def = mark('(') > reference > mark(')');

auto const test = [](auto const& word, Test kind) { return x3::omit[word] >> x3::attr(kind); };

x3::rule<BranchId, ast::If::Branch> const branch = "'#if'";
auto const branch_def = (test(hash("if"), Test::If) > condition > body)
                        | (test(hash("ifdef"), Test::Ifdef) > named_condition > body)
                        | (test(hash("ifndef"), Test::Ifndef) > named_condition > body);

x3::rule<MoreId, ast::If::Branch> const more = "'#else'";
auto const more_def = (test(hash("elseif"), Test::If) > question(condition) > body)
                      | (test(hash("else"), Test::Else) > x3::attr(ast::Expr{}) > body);

x3::rule<IfId, ast::If> const if_ = "'#if'";
auto const if__def =
    with_tail(into(&ast::If::branches)[until_end[first_then(branch, more)]], items);

// ----------------------------------------------------------------------------------------- loops
x3::rule<WhileId, ast::While> const while_ = "'#while'";
auto const while__def = until_end[x3::omit[hash("while")] > condition > body];

x3::rule<ForId, ast::For> const for_ = "'#for'";
auto const for__def =
    until_end[x3::omit[hash("for")] > mark('(') > NewName("a counter") > -mark(',')
              > (full_expression % -mark(',')) > -mark(',') > mark(')') > body];

// --------------------------------------------------------------------------------------- #switch
auto const kind = [](auto const& word, Kind which) { return x3::omit[word] >> x3::attr(which); };
x3::rule<struct BoundsId, std::vector<ast::Expr>> const one_bound = "'('";
auto const one_bound_def = mark('(') > x3::repeat(1)[full_expression] > mark(')');
x3::rule<struct TwoBoundsId, std::vector<ast::Expr>> const two_bounds = "'('";
auto const two_bounds_def = mark('(') > full_expression > -mark(',') > full_expression > mark(')');

x3::rule<ClauseId, ast::Switch::Clause> const clause = "'#case'";
auto const clause_def =
    (kind(hash("case"), Kind::Case) > question(one_bound) > body)
    | (kind(hash("range"), Kind::Range) > question(two_bounds) > body)
    | (kind(hash("else"), Kind::Else) > x3::attr(std::vector<ast::Expr>{}) > body);

x3::rule<SwitchId, ast::Switch> const switch_ = "'#switch'";
auto const switch__def = until_end[x3::omit[hash("switch")] > condition > body > *clause];

auto const conditional_def = if_ | while_ | for_ | switch_;

BOOST_SPIRIT_DEFINE(conditional, condition, named_condition, branch, more, if_, while_, for_,
                    one_bound, two_bounds, clause, switch_)

} // namespace abbe::grammar::rules
