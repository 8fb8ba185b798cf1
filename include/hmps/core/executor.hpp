// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/first_failure.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
struct AnyBody {
  void operator()(std::size_t) const {}
};

/// A type-erased executor, so that code whose loops are few or long is compiled only once.
using AnyExecutor = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;
}  // namespace detail

/// Runs the loops of the library: `execute(n, body)` calls `body(i)` exactly once for every `i` in `[0, n)`, in any
/// order and possibly concurrently, and returns when all calls have returned. Models: `Serial`, `OpenMP`, `OneTBB`, a
/// lambda. The loop bodies of the library never write to the same memory, so results do not depend on the executor.
///
/// The body that an executor of your own gets from the library never throws, so an executor needs no handler, and may
/// consist of threads or of a plain `#pragma omp parallel for`. If an index fails, whether in the library or in a
/// callable of yours such as a shape, a law or a term, the others may or may not still run, and the library throws the
/// exception of the lowest index when the executor returns. `OpenMP` and `OneTBB`
/// also pass on exceptions of bodies of your own.
template <class E>
concept Executor = requires(const E& execute, std::size_t n, detail::AnyBody body) {
  execute(n, body);
};

/// Runs every loop in order on the calling thread.
struct Serial {
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    for (std::size_t i = 0; i < n; ++i) body(i);
  }
};

namespace detail {

/// `execute` for the loops of the library: see `guarded`.
template <class E>
class Guarded {
 public:
  explicit Guarded(const E& execute) : execute_(execute) {}

  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    if constexpr (std::is_same_v<E, Serial>) {
      execute_(n, body);
    } else {
      FirstFailure failure;
      execute_(n, [&](std::size_t i) {
        try {
          body(i);
        } catch (...) {
          failure.keep(i);
        }
      });
      failure.rethrow();
    }
  }

 private:
  const E& execute_;
};

/// Every loop of the library is `guarded(execute)(n, body)`: an exception of the body does not reach `execute`, which
/// may be a plain loop on several threads, where it would end the program. That of the lowest index is thrown after the
/// loop. Free for bodies that cannot throw: the compiler drops the handler.
template <class E>
[[nodiscard]] Guarded<E> guarded(const E& execute) {
  return Guarded<E>(execute);
}

inline constexpr std::size_t chunk = 1024;  // indices of a loop that are run together

/// Calls `body(i)` for every `i` in `[0, n)`, with one call through `execute` for each chunk: for short bodies and a
/// type-erased executor.
template <class Body>
void for_each_in_chunks(std::size_t n, const AnyExecutor& execute, const Body& body) {
  guarded(execute)((n + chunk - 1) / chunk, [&](std::size_t c) {
    const std::size_t end = std::min(n, (c + 1) * chunk);
    for (std::size_t i = c * chunk; i < end; ++i) body(i);
  });
}
}  // namespace detail

/// Folds `term(i)` for `i` in `[0, n)` with `combine`, starting from `start`. Chunks have a fixed length and are
/// combined in order, so the result is identical to the bit for any executor.
template <class T, class Term, class Combine, Executor E = Serial>
[[nodiscard]] T reduce(std::size_t n, T start, Term&& term, Combine&& combine, const E& execute = {}) {
  static_assert(!std::same_as<T, bool>, "hmps: reduce to int, not bool: the chunks are written concurrently");
  static_assert(!(std::integral<T> && std::floating_point<std::remove_cvref_t<decltype(term(n))>>),
                "hmps: reduce starts from an integer, to which its terms would be rounded; start from 0.0");
  constexpr std::size_t chunk = detail::chunk;
  const std::size_t chunks = (n + chunk - 1) / chunk;
  std::vector<T> partial;  // assigned, because g++ 12 warns of an invalid free in the filling constructor
  partial.assign(chunks, start);
  detail::guarded(execute)(chunks, [&](std::size_t c) {
    const std::size_t end = std::min(n, (c + 1) * chunk);
    T sum = term(c * chunk);
    for (std::size_t i = c * chunk + 1; i < end; ++i) sum = combine(sum, term(i));
    partial[c] = sum;
  });
  T result = start;
  for (const T& part : partial) result = combine(result, part);
  return result;
}

}  // namespace hmps::inline HMPS_ABI
