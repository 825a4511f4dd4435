#include "tests/lab/report/html_page.h"

#include "protocol/base/files/atomic_file.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace relume::lab {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1120px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums}"
    "td,th{padding:.2em .7em;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}"
    "td:first-child,th:first-child{text-align:left}"
    "svg,img{max-width:100%;height:auto}"
    ".warning{background:#fde2d0;padding:.6em 1em;border-left:4px solid #d55e00}";

std::string escaped(const std::string& text) {
    std::string html;
    for (const char c : text) {
        switch (c) {
            case '&':
                html += "&amp;";
                break;
            case '<':
                html += "&lt;";
                break;
            case '>':
                html += "&gt;";
                break;
            default:
                html += c;
        }
    }
    return html;
}

std::string content_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::string row(const std::vector<std::string>& cells, const char* tag) {
    std::string html = "<tr>";
    for (const std::string& cell : cells) {
        html += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
    }
    return html + "</tr>\n";
}

}  // namespace

HtmlPage::HtmlPage(const std::string& title) : title_(title) {
    body_ = fmt::format("<h1>{}</h1>\n", escaped(title));
}

void HtmlPage::heading(const std::string& text) {
    body_ += fmt::format("<h2>{}</h2>\n", escaped(text));
}

void HtmlPage::paragraph(const std::string& text) {
    body_ += fmt::format("<p>{}</p>\n", escaped(text));
}

void HtmlPage::warning(const std::string& text) {
    body_ += fmt::format("<p class=\"warning\">{}</p>\n", escaped(text));
}

void HtmlPage::table(const std::vector<std::string>& headings,
                     const std::vector<std::vector<std::string>>& rows) {
    body_ += "<table>\n" + row(headings, "th");
    for (const std::vector<std::string>& cells : rows) {
        body_ += row(cells, "td");
    }
    body_ += "</table>\n";
}

void HtmlPage::svg(const std::filesystem::path& file) {
    const std::string text = content_of(file);
    const std::size_t begin = text.find("<svg");
    if (begin == std::string::npos) {
        throw std::runtime_error(file.string() + ": expected an SVG picture");
    }
    // gnuplot gives the same ids to every chart; in one page they would be mixed up.
    static const std::regex kId(R"((\bid="|xlink:href="#|url\(#))");
    body_ += std::regex_replace(text.substr(begin), kId, fmt::format("$1chart{}-", charts_));
    body_ += '\n';
    charts_ += 1;
}

void HtmlPage::png(const std::filesystem::path& file) {
    body_ += fmt::format("<p><img alt=\"{}\" src=\"data:image/png;base64,{}\"></p>\n",
                         escaped(file.stem().string()),
                         OIIO::Strutil::base64_encode(content_of(file)));
}

void HtmlPage::write(const std::filesystem::path& file) const {
    const std::string html = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>\n"
        "<style>{}</style></head>\n<body>\n{}</body></html>\n",
        escaped(title_), kStyle, body_);
    files::write_file_atomically(file, {files::bytes_of(html)});
}

}  // namespace relume::lab
