// The self-contained page.
#include "tests/lab/charts/pareto_chart.h"
#include "tests/lab/report/html_page.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace relume::lab {
namespace {

std::string content_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(HtmlPage, HoldsWhatItShowsAndLoadsNothing) {
    const test::ScratchDirectory scratch;
    const auto svg = scratch.path() / "chart.svg";
    std::ofstream(svg) << "<?xml version=\"1.0\"?>\n<svg><g id=\"a\"/><use "
                          "xlink:href=\"#a\"/><g clip-path=\"url(#a)\"/></svg>\n";
    const auto png = scratch.path() / "picture.png";
    std::ofstream(png) << "not really a picture";
    HtmlPage page("a < b & c");
    page.svg(svg);
    page.svg(svg);
    page.png(png);
    page.table({"x"}, {{"<1>"}});
    page.write(scratch.path() / "page.html");
    const std::string html = content_of(scratch.path() / "page.html");
    EXPECT_NE(html.find("<h1>a &lt; b &amp; c</h1>"), std::string::npos);
    EXPECT_NE(html.find("&lt;1&gt;"), std::string::npos);
    EXPECT_NE(html.find("src=\"data:image/png;base64,bm90IHJl"), std::string::npos);
    // Each chart refers to its own parts.
    for (const char* part : {"id=\"chart0-a\"", "xlink:href=\"#chart0-a\"", "url(#chart1-a)"}) {
        EXPECT_NE(html.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(html.find("src=\"http"), std::string::npos);
    EXPECT_EQ(html.find("<?xml"), std::string::npos);
}

TEST(HtmlPage, AFileThatIsNotThereIsRefused) {
    HtmlPage page("page");
    EXPECT_THROW(page.svg("/nowhere/chart.svg"), std::runtime_error);
    EXPECT_THROW(page.png("/nowhere/picture.png"), std::runtime_error);
}

TEST(ParetoSeries, IsTheMethodWithoutItsBudget) {
    EXPECT_EQ(series_of("pbi-30-area"), "pbi-area");
    EXPECT_EQ(series_of("guarded-900kB-benefit"), "guarded-benefit");
    EXPECT_EQ(series_of("pbi-dealer-30-area"), "pbi-dealer-area");
}

}  // namespace
}  // namespace relume::lab
