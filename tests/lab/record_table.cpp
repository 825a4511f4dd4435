#include "tests/lab/record_table.h"

#include "protocol/transport/atomic_file.h"

#include <fmt/format.h>

namespace relume::lab {

void write_csv(const std::filesystem::path& file, const std::vector<Record>& records) {
    std::string text =
        "method,image,l2,h1,peak,stated,coefficients,bands_reset,bytes,microseconds\n";
    for (const Record& record : records) {
        text += fmt::format("{},{},{:.6e},{:.6e},{:.6e},{:.6e},{},{},{},{:.1f}\n",
                            record.method, record.image, record.error.l2, record.error.h1,
                            record.error.peak, record.stated_error, record.applied,
                            record.bands_reset, record.bytes_touched, record.microseconds);
    }
    transport::write_file_atomically(file, {transport::bytes_of(text)});
}

}  // namespace relume::lab
