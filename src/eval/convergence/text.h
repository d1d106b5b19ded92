#pragma once
// Writes the results of bench convergence as a text table, CSV and JSON, and as a journal of single frames from which
// an interrupted run continues.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eval/bench_subject.h"
#include "eval/convergence/crops.h"
#include "eval/convergence/rows.h"
#include "frame/driver/reference_image.h"

namespace defocus::engine {

// ---- text tables ----------------------------------------------------------------------------------------------------

std::string convergenceHeader();                         // two lines
std::string convergenceLine(const ConvergenceRow& row);  // one line
// Returns sentences about the reference, the rows that no other row beats, the bias floors and the times to equal
// errors.
std::string convergenceSummary(std::span<const ConvergenceRow> rows, const ReferenceImage& reference);

// ---- results --------------------------------------------------------------------------------------------------------

// Subject of the rows: program, machine and scene, with the crops and the skipped cases.
struct ConvergenceSubject {
    BenchSubject bench;
    std::vector<Crop> crops;
    struct LeftOut {
        std::string method;
        std::string setting;
        std::string reason;
    };
    std::vector<LeftOut> leftOut;
};

// Return the file names of a row's image and of its FLIP map, relative to the folder of the results.
std::string imageName(std::string_view method, std::string_view setting, std::uint32_t asked);
inline constexpr float errorMapFullScale = 0.25f;  // FLIP value of the map's brightest colour; most errors are smaller
std::string errorMapName(std::string_view method, std::string_view setting, std::uint32_t asked);

std::string convergenceCsv(std::span<const ConvergenceRow> rows);
std::string convergenceJson(std::span<const ConvergenceRow> rows, const ReferenceImage& reference,
                            const ConvergenceSubject& subject);

// ---- journal --------------------------------------------------------------------------------------------------------

// Returns one line for each frame, with numbers that read back exactly. `subject` is a hash of the properties that all
// frames of a journal share (scene, reference, device, program).
std::string runsCsv(std::span<const ConvergenceRun> runs, std::uint64_t subject);

// Returns the runs of a journal. The text may be cut off at any byte: an incomplete last line is dropped. Throws Error,
// with the file `name`, if the subject differs or a line is malformed.
std::vector<ConvergenceRun> readRunsCsv(std::string_view text, std::uint64_t subject, const std::string& name);

}  // namespace defocus::engine
