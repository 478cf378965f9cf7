// SPDX-License-Identifier: MIT
#include "lang/function.hpp"

#include "grammar/parse.hpp"
#include "lang/block_function.hpp"
#include "lang/float_functions.hpp"
#include "lang/internal_functions.hpp"
#include "lang/interpreter.hpp"
#include "texture/pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

using Node = FunctionValue::Node;
using Kind = Node::Kind;

std::shared_ptr<FunctionValue const> compile_internal(InternalFunction const&, Interpreter&);

/// Compiles the expression of a body. Loop variables of sum and prod are further parameters.
class Compiler {
public:
  /// @param internal it is one of ours, whose bodies call each other by names of their own
  Compiler(Interpreter& in, FunctionValue& out, ast::Function const& tree, bool internal = false)
      : in_(in), out_(out), internal_(internal) {
    if (tree.has_parameters) {
      for (auto const& name : tree.parameters) names_.push_back({axis(name.text), slots_++});
    } else {
      names_ = {{"x", 0}, {"y", 1}, {"z", 2}};
      slots_ = 3;
    }
    out_.parameters = slots_;
  }

  bool failed() const { return failed_; }

  std::uint32_t compile(ast::Expr const& expr) {
    return ast::visit([&](auto const& node) { return (*this)(node); }, expr);
  }

  std::uint32_t operator()(ast::Number const& node) { return constant(node.value); }
  std::uint32_t operator()(ast::Name const& node) {
    for (auto name = names_.rbegin(); name != names_.rend(); ++name)
      if (name->first == axis(node.text)) return add({Kind::Parameter, 0, 0, name->second, 0});
    return capture(in_.expressions.name(node), node.span);
  }
  std::uint32_t operator()(ast::Unary const& node) {
    std::uint32_t const operand = compile(node.operand);
    if (node.op == ast::UnaryOp::Plus) return operand;
    if (node.op == ast::UnaryOp::Minus) return add({Kind::Negate, operand, 0, 0, 0});
    return wrong("'!' does not belong in a function", node.span);
  }
  std::uint32_t operator()(ast::Binary const& node) {
    constexpr Kind kinds[] = {Kind::Add,   Kind::Sub,      Kind::Mul,          Kind::Div,
                              Kind::And,   Kind::Or,       Kind::Less,         Kind::LessEqual,
                              Kind::Equal, Kind::NotEqual, Kind::GreaterEqual, Kind::Greater};
    std::uint32_t const left = compile(node.left);
    std::uint32_t const right = compile(node.right);
    return add({kinds[static_cast<std::size_t>(node.op)], left, right, 0, 0});
  }
  std::uint32_t operator()(ast::Paren const& node) {
    ast::Expr const* const only = Expressions::sole(node.items);
    return only ? compile(*only) : wrong("expected one expression", node.span);
  }
  std::uint32_t operator()(ast::Member const& node) {
    auto const* const call = ast::get_if<ast::Call>(node.operand);
    if (auto const function = call ? called(*call) : nullptr)
      return user(*call, function, part_of(node.member.text));
    return capture(in_.expressions(node), node.span);
  }
  std::uint32_t operator()(ast::Index const& node) {
    return capture(in_.expressions(node), node.span);
  }
  std::uint32_t operator()(ast::Call const& node) {
    std::string_view const name = node.callee.text;
    if (node.element.empty() && (name == "sum" || name == "prod")) return loop(node);
    if (internal_ && name == "noise") return add_user(noise_generator(), arguments(node), 0);
    if (internal_)
      for (InternalFunction const& helper : internal_functions())
        if (helper.name == name) return add_user(compile_internal(helper, in_), arguments(node), 0);
    if (node.element.empty()
        && (name == "internal" || name == "select" || name == "min" || name == "max"
            || find_float_function(name)))
      return builtin(node);
    if (auto const function = called(node)) return user(node, function, std::nullopt);
    return capture(in_.expressions(node), node.span);
  }
  template <class Other>
  std::uint32_t operator()(Other const& node) {
    return wrong("this does not belong in a function, which is made of floats", node.span);
  }

private:
  /// u and v are other names of x and y.
  static std::string_view axis(std::string_view name) {
    return name == "u" ? "x" : name == "v" ? "y" : name;
  }
  std::uint32_t add(Node node) {
    out_.nodes.push_back(node);
    return static_cast<std::uint32_t>(out_.nodes.size() - 1);
  }
  std::uint32_t constant(double value) { return add({Kind::Constant, 0, 0, 0, value}); }
  std::uint32_t wrong(std::string message, Span span) {
    if (!failed_) in_.error("E0318", std::move(message), span);
    failed_ = true;
    return 0;
  }
  std::uint32_t capture(Numeric const& n, Span span) {
    if (n.poisoned()) {
      failed_ = true;
      return 0;
    }
    if (n.size > 1)
      return wrong("a vector does not belong in a function, which is made of floats", span);
    return constant(n.c[0]);
  }

  std::vector<std::uint32_t> arguments(ast::Call const& node) {
    std::vector<std::uint32_t> places;
    for (auto const& items : node.arguments) {
      ast::Expr const* const only = Expressions::sole(items);
      places.push_back(only ? compile(*only) : wrong("expected one expression", node.span));
    }
    return places;
  }
  std::uint32_t add_call(Node node, std::vector<std::uint32_t> const& places) {
    node.a = static_cast<std::uint32_t>(out_.operands.size());
    node.b = static_cast<std::uint32_t>(places.size());
    out_.operands.insert(out_.operands.end(), places.begin(), places.end());
    return add(node);
  }

  std::uint32_t builtin(ast::Call const& node) {
    auto const places = arguments(node);
    if (failed_) return 0;
    std::string_view const name = node.callee.text;
    if (name == "internal") return internal(node, places);
    Builtin const* const function = find_builtin(in_.scope.symbol(node.callee));
    ABBE_ASSERT(function);
    FloatFunction const* const plain = find_float_function(name);
    bool const right_count = plain ? static_cast<int>(places.size()) == plain->arguments
                             : name == "select" ? places.size() == 3 || places.size() == 4
                                                : places.size() >= 2; // as POV-Ray's
    if (!right_count)
      return wrong(fmt::format("wrong number of arguments of '{}'", name), node.span);
    if (plain)
      return add_call(
          {Kind::Builtin, 0, 0, static_cast<std::uint32_t>(plain - float_functions().data()), 0},
          places);
    Kind const kind = name == "select" ? Kind::Select : name == "min" ? Kind::Min : Kind::Max;
    return add_call({kind, 0, 0, 0, 0}, places);
  }

  /// `internal(n)`: the body of the functions of functions.inc.
  std::uint32_t internal(ast::Call const& node, std::vector<std::uint32_t> const& places) {
    if (places.size() != 1 || out_.nodes[places[0]].kind != Kind::Constant)
      return wrong("'internal' takes one number", node.span);
    int const number = static_cast<int>(out_.nodes[places[0]].value);
    if (number == 76) {
      out_.parameters = 3;
      return add({Kind::Noise, 0, 0, 0, 0});
    }
    if (number == 78) {
      out_.parameters = 4;
      return add({Kind::NoiseGenerator, 0, 0, 0, 0});
    }
    if (number == 29 || number == 59) {
      out_.parameters = 9;
      return add({number == 29 ? Kind::Hetero : Kind::Ridged, 0, 0, 0, 0});
    }
    auto const functions = internal_functions();
    auto const found = std::ranges::find(functions, number, &InternalFunction::number);
    if (number < 0 || found == functions.end())
      return unsupported(fmt::format("the internal function {} is not supported yet", number));
    auto const function = compile_internal(*found, in_);
    out_.parameters = function->parameters;
    std::vector<std::uint32_t> parameters;
    for (std::uint32_t i = 0; i < function->parameters; ++i)
      parameters.push_back(add({Kind::Parameter, 0, 0, i, 0}));
    return add_user(function, parameters, 0);
  }
  /// `internal(78)` as a function that others call.
  static std::shared_ptr<FunctionValue const> noise_generator() {
    auto out = std::make_shared<FunctionValue>();
    out->parameters = 4;
    out->nodes = {{Kind::NoiseGenerator, 0, 0, 0, 0}};
    return out;
  }
  std::uint32_t unsupported(std::string why) {
    out_.unsupported = std::move(why);
    return constant(0);
  }

  /// The function that is called, null when it is none of the user's.
  std::shared_ptr<FunctionValue const> called(ast::Call const& node) {
    Value const* const callee = node.element.empty()
                                    ? in_.scope.find(in_.scope.symbol(node.callee))
                                    : in_.expressions.set_element(node.element.front());
    auto const* function =
        callee ? std::get_if<std::shared_ptr<FunctionValue>>(&callee->any) : nullptr;
    return function ? *function : nullptr;
  }

  /// sum(i, first, last, term)
  std::uint32_t loop(ast::Call const& node) {
    auto const* variable = node.arguments.size() == 4 && node.arguments[0].size() == 1
                               ? ast::get_if<ast::Name>(node.arguments[0][0])
                               : nullptr;
    ast::Expr const* parts[3] = {};
    for (std::size_t i = 0; variable && i < 3; ++i)
      parts[i] = Expressions::sole(node.arguments[i + 1]);
    if (!variable || !parts[0] || !parts[1] || !parts[2])
      return wrong(fmt::format("'{}' takes a variable, its first and last value, and a term",
                               node.callee.text),
                   node.span);
    std::uint32_t const first = compile(*parts[0]);
    std::uint32_t const last = compile(*parts[1]);
    std::uint32_t const slot = slots_++;
    out_.slots = std::max<std::size_t>(out_.slots, slots_);
    names_.push_back({variable->text, slot});
    std::uint32_t const term = compile(*parts[2]);
    names_.pop_back();
    return add_call({node.callee.text == "sum" ? Kind::Sum : Kind::Product, 0, 0, slot, 0},
                    {first, last, term});
  }

  /// @param part that is taken of what a function made of a block yields
  std::uint32_t user(ast::Call const& node, std::shared_ptr<FunctionValue const> const& function,
                     std::optional<int> part) {
    if (!function->unsupported.empty()) return unsupported(function->unsupported);
    if (function->vector && !part)
      return wrong(
          fmt::format("'{0}' yields a vector: take a part of it, '{0}(...).x'", node.callee.text),
          node.span);
    auto const places = arguments(node);
    if (failed_) return 0;
    if (places.size() != function->parameters)
      return wrong(fmt::format("'{}' takes {} arguments, not {}", node.callee.text,
                               function->parameters, places.size()),
                   node.span);
    return add_user(function, places, part.value_or(0));
  }
  std::uint32_t add_user(std::shared_ptr<FunctionValue const> const& function,
                         std::vector<std::uint32_t> const& places, int part) {
    ABBE_ASSERT(places.size() == function->parameters);
    out_.called.push_back(function);
    auto const index = static_cast<std::uint32_t>(out_.called.size() - 1);
    Kind const kind = function->block ? Kind::Part : Kind::Function;
    return add_call({kind, 0, 0, index, static_cast<double>(part)}, places);
  }

  Interpreter& in_;
  FunctionValue& out_;
  std::vector<std::pair<std::string_view, std::uint32_t>> names_;
  std::uint32_t slots_ = 0;
  bool internal_;
  bool failed_ = false;
};

std::shared_ptr<FunctionValue const> compile_internal(InternalFunction const& function,
                                                      Interpreter& in) {
  if (auto const known = in.internals.find(&function); known != in.internals.end())
    return known->second;
  SourceFile const source(fmt::format("internal({})", function.number),
                          fmt::format("#declare F = function{};", function.text));
  Parsed const parsed = parse(source);
  ABBE_ASSERT(parsed.errors.empty());
  auto const& declare = *ast::get_if<ast::Declare>(parsed.document.items.at(0));
  ast::Expr const* const value = Expressions::sole(declare.value);
  ABBE_ASSERT(value);
  auto const& tree = *ast::get_if<ast::Function>(*value);
  auto out = std::make_shared<FunctionValue>();
  Compiler compiler(in, *out, tree, true);
  std::uint32_t const result = compiler.compile(*Expressions::sole(tree.body));
  ABBE_ASSERT(!compiler.failed() && result + 1 == out->nodes.size());
  in.internals[&function] = out; // those that it calls came in meanwhile
  return out;
}

/// The two sizes of `function 100, 80 { ... }`.
bool read_picture_size(ast::Function const& tree, Interpreter& in, FunctionValue& out) {
  constexpr double most = 32768;
  int sizes[2] = {0, 0};
  bool good = tree.sizes.size() == 2;
  for (std::size_t i = 0; good && i < 2; ++i) {
    double const size = in.expressions.scalar(tree.sizes[i], "the size of a picture");
    good = size >= 1 && size <= most;
    if (good) sizes[i] = static_cast<int>(size);
  }
  if (!good)
    in.error(
        "E0318",
        "a function that stands for a picture has a width and a height: 'function 100, 80 { ... }'",
        tree.span);
  out.picture_width = sizes[0];
  out.picture_height = sizes[1];
  return good;
}

} // namespace

std::shared_ptr<FunctionValue> make_function(ast::Function const& tree, Interpreter& in) {
  auto function = std::make_shared<FunctionValue>();
  Compiler compiler(in, *function, tree);
  if (!tree.sizes.empty() && !read_picture_size(tree, in, *function)) return nullptr;
  in.reader.enter_region(tree.body, tree.span);
  bool const made_of_block = in.reader.next() == Next::Block;
  if (made_of_block) read_block_function(in.reader, *function);
  ast::Expr const* const body = made_of_block ? nullptr : in.reader.take_expression();
  bool good = body != nullptr || function->block || !function->unsupported.empty();
  if (!good && !made_of_block) {
    in.error("E0318", "expected the expression of a function", tree.span);
  } else if (body) {
    std::uint32_t const result = compiler.compile(*body);
    good = !compiler.failed();
    if (good && result + 1 != function->nodes.size())
      function->nodes.push_back(function->nodes[result]);
  }
  if (!good)
    while (!in.reader.at_end()) in.reader.skip();
  in.reader.leave_region();
  return good ? function : nullptr;
}

} // namespace abbe::lang
