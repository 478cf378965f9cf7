// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/config.hpp"

/// Items: whatever may stand between braces, and the lists of them.
namespace abbe::grammar::rules {

struct ItemsId;
struct ArgumentId;
struct BodyId;
struct BlockId;
struct OperandId;

/// Any number of items with commas between.
using ItemsRule = x3::rule<ItemsId, ast::Items>;
/// Items up to a comma or ')': one argument of a call.
using ArgumentRule = x3::rule<ArgumentId, ast::Items>;
/// The items of a directive's body up to the directive that ends it, or a Text.
using BodyRule = x3::rule<BodyId, ast::Items>;
using BlockRule = x3::rule<BlockId, ast::Block>;
/// A block, array, function or expression.
using OperandRule = x3::rule<OperandId, ast::Expr>;

ItemsRule const items = "items";
ArgumentRule const argument = "an argument";
BodyRule const body = "items";
BlockRule const block = "a block";
OperandRule const operand = "a value";

/// An item alone, without commas around.
struct ItemId;
using ItemRule = x3::rule<ItemId, ast::Item>;
ItemRule const item = "an item";

BOOST_SPIRIT_DECLARE(ItemsRule, ArgumentRule, BodyRule, BlockRule, OperandRule, ItemRule)

} // namespace abbe::grammar::rules
