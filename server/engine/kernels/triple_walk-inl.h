// The walk over the squares of a receiver, for any vector of four floats. Included once for
// each instruction set, within its namespace, after `Lanes4` is defined:
//     V load(const float*), set(float), signs(a, b, c, d), mul(V, V), fused(V a, V b, V c) = ab
//     + c void store(V, float*) V exchange<1|2|3>(V): lane i gets lane i xor that V
//     with_first(V, float): lane 0 replaced
// It has no include guard on purpose.

// Sums over the four quarters of a square whose mean is in lane 0, over the quarters'
// amplitude.
template <typename Lanes4>
RELUME_WALK_INLINE void store_quarter_means(typename Lanes4::V square, float* quarters) {
    // Lanes m, c, r, b: m ± c ± r ± b. First m ± c and r ± b, then both together.
    const auto along_columns = Lanes4::fused(Lanes4::signs(1, -1, 1, -1), square,
                                             Lanes4::template exchange<1>(square));
    // m + c, m − c, r + b, r − b
    const auto along_rows = Lanes4::fused(Lanes4::signs(1, 1, -1, -1), along_columns,
                                          Lanes4::template exchange<2>(along_columns));
    Lanes4::store(Lanes4::mul(Lanes4::set(0.5F), along_rows), quarters);
}

// w_k = Σ_i v_i p_(i xor k): the product of two functions within a square.
template <typename Lanes4>
RELUME_WALK_INLINE typename Lanes4::V product_within_square(const float* v,
                                                            typename Lanes4::V p) {
    auto w = Lanes4::mul(Lanes4::set(v[0]), p);
    w = Lanes4::fused(Lanes4::set(v[1]), Lanes4::template exchange<1>(p), w);
    w = Lanes4::fused(Lanes4::set(v[2]), Lanes4::template exchange<2>(p), w);
    return Lanes4::fused(Lanes4::set(v[3]), Lanes4::template exchange<3>(p), w);
}

// Adds the functions' squares of a face up, and notes which ones there are.
template <typename Lanes4>
RELUME_WALK_INLINE float mix_material(std::span<const WeightedWavelets> material,
                                      std::size_t face,
                                      TripleWorkspace::Face& work) {
    float scaling = 0;
    for (const WeightedWavelets& part : material) {
        scaling = std::fma(part.weight, part.function.scaling[face], scaling);
        const auto weight = Lanes4::set(part.weight);
        const std::uint32_t end = part.function.first[face + 1];
        for (std::uint32_t i = part.function.first[face]; i < end; ++i) {
            const std::size_t square = part.function.squares[i];
            float* sum = work.material[square].data();
            Lanes4::store(Lanes4::fused(weight, Lanes4::load(part.function.values[i].data()),
                                        Lanes4::load(sum)),
                          sum);
            work.kept[square / tripling::kWordBits] |= std::uint64_t{1}
                                                       << square % tripling::kWordBits;
        }
    }
    return scaling;
}

// Squares that the material keeps, coarsest first: cases 2 and 3 with the material in the pair.
template <typename Lanes4>
RELUME_WALK_INLINE void multiply_kept_squares(const tripling::VisibilityView& visibility,
                                              std::size_t face,
                                              TripleWorkspace& workspace) {
    TripleWorkspace::Face& work = workspace.face();
    const std::uint32_t n = workspace.face_resolution();
    const std::size_t first_square = face * tripling::face_stride(n);
    const std::size_t parents = tripling::square_count(n / 2);
    for (std::size_t word = 0; word < work.kept.size(); ++word) {
        for (std::uint64_t bits = work.kept[word]; bits != 0; bits &= bits - 1) {
            const std::size_t square =
                word * tripling::kWordBits + static_cast<std::size_t>(std::countr_zero(bits));
            const auto p = Lanes4::load(work.material[square].data());
            Lanes4::store(Lanes4::set(0), work.material[square].data());
            alignas(16) std::array<float, 4> v{work.visible_means[square], 0, 0, 0};
            const bool varies =
                tripling::read_visible_square(n, visibility, face, square, v.data() + 1);
            if (square < parents) {
                const std::size_t quarters = tripling::first_child(square);
                store_quarter_means<Lanes4>(Lanes4::with_first(p, work.material_means[square]),
                                            &work.material_means[quarters]);
                store_quarter_means<Lanes4>(Lanes4::load(v.data()),
                                            &work.visible_means[quarters]);
            }
            if (varies || v[0] != 0) {
                alignas(16) std::array<float, 4> product{};
                Lanes4::store(product_within_square<Lanes4>(v.data(), p), product.data());
                workspace.append(first_square + square, product.data());
            }
        }
    }
}

// Squares where light and visibility vary: case 3 with the material as the third function.
template <typename Lanes4>
RELUME_WALK_INLINE void multiply_light_terms(const tripling::VisibilityView& visibility,
                                             std::span<const std::uint64_t> light_terms,
                                             std::size_t face,
                                             TripleWorkspace& workspace) {
    const TripleWorkspace::Face& work = workspace.face();
    const std::uint32_t n = workspace.face_resolution();
    const std::size_t first_square = face * tripling::face_stride(n);
    const std::size_t first_word = first_square / tripling::kWordBits;
    const auto is_kept = [&](std::size_t square) {
        return (work.kept[square / tripling::kWordBits] >> square % tripling::kWordBits & 1U) !=
               0;
    };
    for (std::size_t word = 0; word < work.kept.size(); ++word) {
        for (std::uint64_t bits =
                 light_terms[first_word + word] & visibility.words[first_word + word];
             bits != 0; bits &= bits - 1) {
            const std::size_t square =
                word * tripling::kWordBits + static_cast<std::size_t>(std::countr_zero(bits));
            // Below the finest square that is kept the material is constant, and its mean over
            // an amplitude halves from level to level.
            std::size_t known = square;
            float mean = 1;
            while (known != 0 && !is_kept(tripling::parent_square(known))) {
                known = tripling::parent_square(known);
                mean *= 0.5F;
            }
            mean *= work.material_means[known];
            if (mean == 0) {
                continue;
            }
            alignas(16) std::array<float, 4> v{};
            (void)tripling::read_visible_square(n, visibility, face, square, v.data() + 1);
            Lanes4::store(Lanes4::mul(Lanes4::set(mean), Lanes4::load(v.data())), v.data());
            workspace.append(first_square + square, v.data());
        }
    }
}

template <typename Lanes4>
void walk_receiver(const tripling::VisibilityView& visibility,
                   std::span<const WeightedWavelets> material,
                   std::span<const std::uint64_t> light_terms,
                   TripleWorkspace& workspace) {
    const std::uint32_t n = workspace.face_resolution();
    TripleWorkspace::Face& work = workspace.face();
    workspace.clear();
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        const float visible_scaling = visibility.faces[face].scaling;
        if (visible_scaling == 0) {
            continue;  // closed as a whole
        }
        work.material_means[0] = mix_material<Lanes4>(material, face, work);
        work.visible_means[0] = visible_scaling;
        const std::array<float, 4> constant{work.material_means[0] * visible_scaling, 0, 0, 0};
        if (constant[0] != 0) {
            workspace.append(face * tripling::face_stride(n), constant.data());
        }
        multiply_kept_squares<Lanes4>(visibility, face, workspace);
        multiply_light_terms<Lanes4>(visibility, light_terms, face, workspace);
        std::fill(work.kept.begin(), work.kept.end(), 0);
    }
}
