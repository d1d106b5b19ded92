#pragma once
// Writes what bench convergence measures: a table for people, results as CSV and JSON, and a journal of single frames
// from which an interrupted run continues.

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

// ---- for people -----------------------------------------------------------------------------------------------------

std::string convergenceHeader();                         // two lines
std::string convergenceLine(const ConvergenceRow& row);  // one line
// Describes in sentences the reference, the rows that no other row beats, the bias floors, and the times to equal
// errors.
std::string convergenceSummary(std::span<const ConvergenceRow> rows, const ReferenceImage& reference);

// ---- results --------------------------------------------------------------------------------------------------------

// Describes what the rows were measured on, and with what.
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

// The names of a row's image and of its FLIP map, relative to the folder of the results.
std::string imageName(std::string_view method, std::string_view setting, std::uint32_t asked);
inline constexpr float errorMapFullScale =
    0.25f;  // the FLIP value that is drawn brightest, because most errors are small
std::string errorMapName(std::string_view method, std::string_view setting, std::uint32_t asked);

std::string convergenceCsv(std::span<const ConvergenceRow> rows);
std::string convergenceJson(std::span<const ConvergenceRow> rows, const ReferenceImage& reference,
                            const ConvergenceSubject& subject);

// ---- journal --------------------------------------------------------------------------------------------------------

// Writes one line for each frame, with numbers to their last bit. `subject` is a hash of everything that the frames of
// one journal must have in common (scene, reference, device, program).
std::string runsCsv(std::span<const ConvergenceRun> runs, std::uint64_t subject);

// Reads the runs of a journal. The text may be cut off at any byte: a last line without its end is dropped. Throws
// Error, with the file `name`, if the subject differs or a line isn't a run.
std::vector<ConvergenceRun> readRunsCsv(std::string_view text, std::uint64_t subject, const std::string& name);

}  // namespace defocus::engine
