// SPDX-License-Identifier: MIT
#pragma once

#include <boost/spirit/home/x3.hpp>

#include <string>

namespace boost::spirit::x3 {

/// A repetition is called by the name of what it repeats: X3 itself would say its C++ type.
template <typename Subject, typename Bounds>
struct get_info<repeat_directive<Subject, Bounds>> {
  using result_type = std::string;
  std::string operator()(repeat_directive<Subject, Bounds> const& parser) const {
    return what(parser.subject);
  }
};
template <typename Subject>
struct get_info<plus<Subject>> {
  using result_type = std::string;
  std::string operator()(plus<Subject> const& parser) const { return what(parser.subject); }
};
template <typename Subject, typename Mark>
struct get_info<list<Subject, Mark>> {
  using result_type = std::string;
  std::string operator()(list<Subject, Mark> const& parser) const { return what(parser.left); }
};

} // namespace boost::spirit::x3
