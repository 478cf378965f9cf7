// SPDX-License-Identifier: MIT
#include "lang/function.hpp"

#include "lang/block_function.hpp"
#include "lang/float_functions.hpp"
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
constexpr double eps = 1e-10;

/// Compiles the expression of a body. Loop variables of sum and prod are further parameters.
class Compiler {
public:
  Compiler(Interpreter& in, FunctionValue& out, ast::Function const& tree) : in_(in), out_(out) {
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
    return unsupported(fmt::format("the internal function {} is not supported yet", number));
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
    out_.called.push_back(function);
    out_.calls_block = out_.calls_block || function->calls_block;
    auto const index = static_cast<std::uint32_t>(out_.called.size() - 1);
    Kind const kind = function->block ? Kind::Part : Kind::Function;
    return add_call({kind, 0, 0, index, static_cast<double>(part.value_or(0))}, places);
  }

  Interpreter& in_;
  FunctionValue& out_;
  std::vector<std::pair<std::string_view, std::uint32_t>> names_;
  std::uint32_t slots_ = 0;
  bool failed_ = false;
};

/// Evaluates nodes; `slots` are the parameters and loop variables.
struct Machine {
  FunctionValue const& function;
  double* slots;

  double operand(Node const& node, std::uint32_t i) const {
    return run(function.operands[node.a + i]);
  }

  double run(std::uint32_t place) const {
    Node const& node = function.nodes[place];
    auto const yes = [](bool b) { return b ? 1.0 : 0.0; };
    switch (node.kind) {
    case Kind::Constant:
      return node.value;
    case Kind::Parameter:
      return slots[node.c];
    case Kind::Add:
      return run(node.a) + run(node.b);
    case Kind::Sub:
      return run(node.a) - run(node.b);
    case Kind::Mul:
      return run(node.a) * run(node.b);
    case Kind::Div:
      return run(node.a) / run(node.b);
    case Kind::And: // comparisons in functions are exact, as POV-Ray's
      return yes(run(node.a) != 0 && run(node.b) != 0);
    case Kind::Or:
      return yes(run(node.a) != 0 || run(node.b) != 0);
    case Kind::Less:
      return yes(run(node.a) < run(node.b));
    case Kind::LessEqual:
      return yes(run(node.a) <= run(node.b));
    case Kind::Equal:
      return yes(run(node.a) == run(node.b));
    case Kind::NotEqual:
      return yes(run(node.a) != run(node.b));
    case Kind::GreaterEqual: // what is not a number is greater than all, as POV-Ray's
      return yes(!(run(node.a) < run(node.b)));
    case Kind::Greater:
      return yes(!(run(node.a) <= run(node.b)));
    case Kind::Negate:
      return -run(node.a);
    case Kind::Builtin:
      return float_functions()[node.c].compute(operand(node, 0), node.b > 1 ? operand(node, 1) : 0);
    case Kind::Noise:
      return texture::noise({slots[0], slots[1], slots[2]});
    case Kind::NoiseGenerator:
      return texture::noise({slots[0], slots[1], slots[2]}, static_cast<int>(slots[3]));
    default:
      return run_call(node);
    }
  }

  double run_call(Node const& node) const {
    switch (node.kind) {
    case Kind::Min:
    case Kind::Max: {
      double value = operand(node, 0);
      for (std::uint32_t i = 1; i < node.b; ++i) {
        double const other = operand(node, i);
        bool const less = value < other; // of what is not a number: not, and so POV-Ray decides
        value = less == (node.kind == Kind::Min) ? value : other;
      }
      return value;
    }
    case Kind::Select: {
      double const which = operand(node, 0);
      if (node.b == 3) return operand(node, which < 0 ? 1 : 2);
      return operand(node, which < 0 ? 1 : which == 0 ? 2 : 3);
    }
    case Kind::Sum:
    case Kind::Product: {
      double total = node.kind == Kind::Sum ? 0 : 1;
      double const last = operand(node, 1);
      for (double i = operand(node, 0); i <= last + eps; i += 1) {
        slots[node.c] = i;
        double const term = operand(node, 2);
        total = node.kind == Kind::Sum ? total + term : total * term;
      }
      return total;
    }
    default: {
      std::array<double, 16> few;
      std::vector<double> many(node.b > few.size() ? node.b : 0);
      double* const arguments = many.empty() ? few.data() : many.data();
      for (std::uint32_t i = 0; i < node.b; ++i) arguments[i] = operand(node, i);
      return take_part(evaluate_function(*function.called[node.c], {arguments, node.b}),
                       static_cast<int>(node.value));
    }
    }
  }
};

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
  function->calls_block = made_of_block;
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

Numeric evaluate_function(FunctionValue const& function, std::span<double const> arguments) {
  ABBE_ASSERT(arguments.size() == function.parameters && function.unsupported.empty());
  if (function.block) return function.block(arguments);
  std::array<double, 16> few;
  std::vector<double> many;
  std::size_t const size = std::max(function.slots, arguments.size());
  if (size > few.size()) many.resize(size);
  double* const slots = many.empty() ? few.data() : many.data();
  std::fill(std::copy(arguments.begin(), arguments.end(), slots), slots + size, 0.0);
  Numeric n;
  n.c[0] = Machine{function, slots}.run(static_cast<std::uint32_t>(function.nodes.size() - 1));
  return n;
}

} // namespace abbe::lang
