// animation [SCENE [FOLDER]]: renders twelve frames of a scene's animation with motion blur while the focus plane moves
// away from the camera. The scene is read and simplified only once.

#include <defocus/defocus.h>

#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

int main(int count, char** words) try {
    const std::filesystem::path folder = count > 2 ? words[2] : "frames";
    std::filesystem::create_directories(folder);

    defocus::Request request;
    if (count > 1) request.scene = words[1];
    request.size = {320, 180};
    request.samples = 16;
    request.lens.fStop = 2;
    request.loop = true;
    request.shutter = 1.0 / 48;

    defocus::SceneRenderer renderer(request);
    for (int frame = 0; frame < 12; ++frame) {
        request.time = frame / 24.0;
        request.focus = defocus::FocusDistance{1.5 + 0.1 * frame};
        std::ostringstream name;
        name << std::setw(4) << std::setfill('0') << frame << ".png";
        renderer.write(folder / name.str(), renderer.render(request));
    }
} catch (const defocus::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
