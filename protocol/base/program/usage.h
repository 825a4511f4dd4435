// What a program says of words it does not understand.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Error.hpp>

#include <stdexcept>
#include <string>

namespace relume::program {

// Words that parsed and still ask for nothing that can be done: the message says what was found
// and expected.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A mistake in the words `app` was given, in one line; for an option or subcommand that does
// not exist with those that resemble it.
[[nodiscard]] std::string text_from_mistake(const CLI::App& app,
                                            const CLI::ParseError& mistake);

}  // namespace relume::program
