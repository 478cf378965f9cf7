// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/config.hpp"

/// Items: whatever may stand between braces, and the lists of them.
namespace abbe::grammar::rules {

struct ItemsId;
struct ArgumentId;
struct BlockId;
struct OperandId;

/// Any number of items with commas between.
using ItemsRule = x3::rule<ItemsId, ast::Items>;
/// Items up to a comma or ')': one argument of a call.
using ArgumentRule = x3::rule<ArgumentId, ast::Items>;
using BlockRule = x3::rule<BlockId, ast::Block>;
/// A block, array, function or expression.
using OperandRule = x3::rule<OperandId, ast::Expr>;

ItemsRule const items = "items";
ArgumentRule const argument = "an argument";
BlockRule const block = "a block";
OperandRule const operand = "a value";

BOOST_SPIRIT_DECLARE(ItemsRule, ArgumentRule, BlockRule, OperandRule)

} // namespace abbe::grammar::rules
