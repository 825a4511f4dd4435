// Small files of materials, to begin with: write_material_seeds FOLDER.
#include "protocol/tripling/material_file.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace {

namespace tripling = relume::tripling;

void write_seed(const std::filesystem::path& folder, std::size_t lobes, std::uint32_t normals) {
    tripling::MaterialField field;
    field.name = "seed-" + std::to_string(lobes);
    field.normals = tripling::DirectionGrid(normals);
    for (std::size_t lobe = 0; lobe < lobes; ++lobe) {
        field.colours.emplace_back(1.0F, 0.5F, 0.0F);
        auto& store = field.lobes.emplace_back(4);
        for (std::size_t entry = 0; entry < field.entry_count(); ++entry) {
            std::vector<float> coefficients(96);
            for (std::size_t i = 0; i < coefficients.size(); ++i) {
                coefficients[i] = static_cast<float>((7 * i + entry) % 5);
            }
            store.append(tripling::SparseWavelets(
                tripling::squares_of_energy(4, coefficients, 0.5), coefficients));
        }
    }
    tripling::write_material_file(folder / (field.name + ".material"), field);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        return 2;
    }
    std::filesystem::create_directories(argv[1]);
    write_seed(argv[1], 1, 1);
    write_seed(argv[1], 2, 2);
    return 0;
}
