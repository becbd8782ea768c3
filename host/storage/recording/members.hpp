// The members of a plain struct with their names, in the order of their declaration: state and tables of the core are
// recorded by them, without a list that could miss one.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace liana::recording {

struct AnyMember {
  template <class T>
  operator T() const;  // never defined
};

// How many members a struct has: as many values as its braces take.
template <class T, class... Members>
consteval std::size_t member_count() {
  if constexpr (requires { T{std::declval<Members>()..., std::declval<AnyMember>()}; })
    return member_count<T, Members..., AnyMember>();
  return sizeof...(Members);
}

// References to all members. C++20 can name so many only one number at a time.
template <class T>
constexpr auto members_of(T& value) {
  constexpr std::size_t kCount = member_count<std::remove_const_t<T>>();
  static_assert(kCount > 0 && kCount <= 22, "one more LIANA_MEMBERS");
#define LIANA_MEMBERS(count, ...)              \
  if constexpr (kCount == count) {             \
    auto& [__VA_ARGS__] = value;               \
    return std::forward_as_tuple(__VA_ARGS__); \
  }
  LIANA_MEMBERS(1, a)
  LIANA_MEMBERS(2, a, b)
  LIANA_MEMBERS(3, a, b, c)
  LIANA_MEMBERS(4, a, b, c, d)
  LIANA_MEMBERS(5, a, b, c, d, e)
  LIANA_MEMBERS(6, a, b, c, d, e, f)
  LIANA_MEMBERS(7, a, b, c, d, e, f, g)
  LIANA_MEMBERS(8, a, b, c, d, e, f, g, h)
  LIANA_MEMBERS(9, a, b, c, d, e, f, g, h, i)
  LIANA_MEMBERS(10, a, b, c, d, e, f, g, h, i, j)
  LIANA_MEMBERS(11, a, b, c, d, e, f, g, h, i, j, k)
  LIANA_MEMBERS(12, a, b, c, d, e, f, g, h, i, j, k, l)
  LIANA_MEMBERS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
  LIANA_MEMBERS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
  LIANA_MEMBERS(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
  LIANA_MEMBERS(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
  LIANA_MEMBERS(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
  LIANA_MEMBERS(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
  LIANA_MEMBERS(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
  LIANA_MEMBERS(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
  LIANA_MEMBERS(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
  LIANA_MEMBERS(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
#undef LIANA_MEMBERS
}

template <class T>
inline constexpr T kSample{};

// Clang 14 takes the address of a member as a template argument only inside of something.
template <class T>
struct Address {
  T* of;
};
template <class T>
Address(T*) -> Address<T>;
template <auto A>
constexpr auto printed() {
  return std::string_view(__PRETTY_FUNCTION__);
}

// Of "... [with Address<...> A = Address<const double>{(& kSample<...>.liana::Pose::position_m)}; ...]" the last name
// before the brace closes.
constexpr std::string_view last_name(std::string_view text) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  const std::size_t end = text.find_last_of(kLetters, text.rfind('}')) + 1;
  const std::size_t begin = text.find_last_not_of(kLetters, end - 1) + 1;
  return text.substr(begin, end - begin);
}

// The name of member I, ended by a zero.
template <class T, std::size_t I>
constexpr auto kMemberName = [] {
  constexpr std::string_view kName = last_name(printed<Address{&std::get<I>(members_of(kSample<T>))}>());
  std::array<char, kName.size() + 1> text{};
  kName.copy(text.data(), kName.size());
  return text;
}();

// Calls a(name, member) for each.
template <class A, class T>
void visit_members(A& a, T& value) {
  const auto members = members_of(value);
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (a(kMemberName<std::remove_const_t<T>, I>.data(), std::get<I>(members)), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(members)>>());
}

}  // namespace liana::recording
