// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast.hpp"

#include <boost/fusion/include/adapt_struct.hpp>

// The nodes with several members, in the order in which the rules fill them. Leaf nodes are made
// whole by the terminals, nodes with one list by `into` (components.hpp); spans are set by
// `tag_span`.
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Index, array, subscripts)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Block, head, items)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Array, sizes, has_elements, elements)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Function, has_parameters, parameters, sizes, body)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::If::Branch, test, condition, items)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::While, condition, items)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::For, counter, arguments, items)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Switch, value, before, clauses)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Switch::Clause, kind, bounds, items)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Declare, local, deprecated, deprecated_once, deprecation,
                          target, value, has_semicolon)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Macro, name, parameters, body)
BOOST_FUSION_ADAPT_STRUCT(abbe::ast::Directive, word, arguments)
