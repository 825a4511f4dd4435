#include "protocol/base/program/usage.h"

#include "protocol/base/text/near_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace relume::program {
namespace {

// Of the program and of the subcommands it was given.
void add_options(const CLI::App& app, std::vector<std::string>& names) {
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    for (const CLI::App* chosen : app.get_subcommands()) {
        add_options(*chosen, names);
    }
}

std::vector<std::string> names_like(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    if (word.starts_with('-')) {
        add_options(app, names);
    } else {
        for (const CLI::App* command :
             app.get_subcommands([](const CLI::App* /*any*/) { return true; })) {
            names.push_back(command->get_name());
        }
    }
    return text::near_names(word.substr(0, word.find('=')), names);
}

}  // namespace

std::string text_from_mistake(const CLI::App& app, const CLI::ParseError& mistake) {
    std::string message = mistake.what();
    message.erase(message.find_last_not_of('\n') + 1);
    std::replace(message.begin(), message.end(), '\n', ' ');
    for (const std::string& word : app.remaining(/*recurse=*/true)) {
        if (const auto near = names_like(app, word); !near.empty()) {
            message +=
                fmt::format("; found {}, did you mean {}?", word, fmt::join(near, " or "));
            break;
        }
    }
    return message;
}

}  // namespace relume::program
