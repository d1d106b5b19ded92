// render [SCENE [IMAGE]]: renders one image. The default scene is the built-in school of fish.

#include <defocus/defocus.h>

#include <iostream>

int main(int count, char** words) try {
    defocus::Request request;
    if (count > 1) request.scene = words[1];
    request.lens.fStop = 1.4;
    defocus::writeImage(count > 2 ? words[2] : "out.exr", defocus::render(request));
} catch (const defocus::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
