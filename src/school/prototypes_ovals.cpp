#include "school/prototypes.h"

namespace defocus::engine::prototypes {

// ---- species of oval fish --------------------------------------------------------------------------

Fish anthias(int variant) {
    Fish fish{.species = "Anthias", .shape = {}, .pattern = {}};
    FishShape& s = fish.shape;
    s.outline = {{0, .06f, .128f, .185f, .2f, .187f, .15f, .098f, .062f},
                 {0, .055f, .11f, .16f, .18f, .172f, .138f, .088f, .058f},
                 {0, .045f, .08f, .10f, .105f, .095f, .075f, .045f, .022f}};
    s.medianFins = {{FinKind::dorsal, .25f, .9f, {.08f, .16f, .12f, .12f, .15f, .05f}, .5f, 1.0f, .2f, .16f, 18},
                    {FinKind::anal, .58f, .88f, {.05f, .13f, .16f, .15f, .10f, .03f}, .6f, 1.0f, .25f, .05f, 11}};
    s.caudal = {.42f, .62f, .68f, .0f, 22};
    s.pectoral = {FinKind::pectoral, .3f, -.1f, .248f, 1.0f, .5f, .3f, .05f, 13};
    s.pelvic = {FinKind::pelvic, .33f, -.82f, .291f, .4f, .2f, .6f, .03f, 8};
    s.eyeRadius = .037f;
    FishPattern& p = fish.pattern;
    if (variant % 3 == 0) {  // palette: orange to rose
        setBody(p, 0xff6a14, 0xff8426, 0xffb070);
        p.rear = rgb(0xff5a4a);
        p.rearStart = .62f;
        p.rearSoftness = .35f;
        p.face = rgb(0xff9a3c);
        p.faceAmount = .5f;
        p.stripes = {1.7f, .10f, .0f, .0f, .03f, .3f, rgb(0xd94fb0)};
        setMedianFins(p, 0xff7a2a, 0xffa04a);
        p.medianRim = rgb(0xc850d8);
        p.medianRimWidth = .16f;
        setCaudalFin(p, 0xff6a34, 0xffa860);
        p.caudalRim = rgb(0xe04aa8);
        p.caudalRimWidth = .13f;
    } else if (variant % 3 == 1) {  // palette: magenta to amber
        setBody(p, 0x8a2fc0, 0xc83bb4, 0xf28ac0);
        p.rear = rgb(0xff9a2e);
        p.rearStart = .60f;
        p.rearSoftness = .2f;
        p.rearSlant = .1f;
        setMedianFins(p, 0x9a38cc, 0xe85ac0);
        p.medianRim = rgb(0x60c8ff);
        p.medianRimWidth = .1f;
        setCaudalFin(p, 0xffa030, 0xffd070);
        p.caudalRim = rgb(0xf060b0);
        p.caudalRimWidth = .1f;
    } else {  // palette: coral
        setBody(p, 0xe8382c, 0xff5f48, 0xffb49a);
        p.spots = {.055f, .2f, .3f, .95f, -.1f, .95f, rgb(0xffd24a), {}, 0};
        setMedianFins(p, 0xff4a38, 0xff8a5c);
        p.medianRim = rgb(0xffd860);
        p.medianRimWidth = .1f;
        setCaudalFin(p, 0xff5038, 0xffa468);
        p.caudalRim = rgb(0xffd860);
        p.caudalRimWidth = .08f;
    }
    setPairedFins(p, 0xff8a50, 0xffc890);
    p.iris = rgb(0x7a6cf0);
    p.scaleEdge = rgb(0xffe0a0);
    p.scaleEdgeAmount = .3f;
    return fish;
}

Fish tang(int variant) {
    Fish fish{.species = "Tang", .shape = {}, .pattern = {}};
    FishShape& s = fish.shape;
    s.outline = {{0, .07f, .16f, .235f, .262f, .25f, .195f, .105f, .052f},
                 {0, .058f, .125f, .205f, .24f, .238f, .188f, .1f, .05f},
                 {0, .04f, .075f, .10f, .105f, .095f, .07f, .04f, .02f}};
    s.medianFins = {{FinKind::dorsal, .23f, .93f, {.05f, .10f, .11f, .12f, .12f, .06f}, .55f, 1.05f, .2f, .03f, 26},
                    {FinKind::anal, .42f, .93f, {.04f, .09f, .10f, .11f, .10f, .05f}, .55f, 1.05f, .2f, .03f, 20}};
    s.caudal = {.27f, .62f, .36f, .02f, 20};
    s.pectoral = {FinKind::pectoral, .29f, -.05f, .236f, .9f, .55f, .2f, .05f, 13};
    s.pelvic = {FinKind::pelvic, .32f, -.85f, .168f, .4f, .2f, .7f, .025f, 7};
    s.eyeHeight = .42f;
    s.eyeRadius = .03f;
    s.mouthLength = .028f;
    s.gillA = .235f;
    s.scaleSize = .034f;
    FishPattern& p = fish.pattern;
    if (variant % 2 == 0) {  // palette: royal blue with yellow tail
        setBody(p, 0x0f35b8, 0x1b57e6, 0x3d86f5);
        p.bands = {{.86f, .035f, -.10f, .02f, rgb(0x0a1030), {}, 0}};
        p.stripes = {2.2f, .36f, -.35f, .12f, .2f, .86f, rgb(0x0b1238)};
        setMedianFins(p, 0x1647d0, 0x2f7cff);
        p.medianRim = rgb(0x0a1030);
        p.medianRimWidth = .1f;
        setCaudalFin(p, 0xffc400, 0xffe14a);
        p.caudalRim = rgb(0x0d1440);
        p.caudalRimWidth = .1f;
        setPairedFins(p, 0x2f7cf0, 0xffd030);
        p.rear = rgb(0xffc400);
        p.rearStart = .965f;
        p.rearSoftness = .03f;
    } else {  // palette: powder blue
        setBody(p, 0x3a8ee8, 0x58b0f5, 0x9ad6ff);
        p.face = rgb(0x10183a);
        p.faceAmount = .95f;
        setMedianFins(p, 0xffd21e, 0xffe45a);
        p.medianRim = rgb(0xe8f6ff);
        p.medianRimWidth = .08f;
        setCaudalFin(p, 0xf0f6ff, 0x9fd0ff);
        p.caudalRim = rgb(0x16204a);
        p.caudalRimWidth = .08f;
        setPairedFins(p, 0xffd430, 0xfff0a0);
    }
    p.iris = rgb(0xc07828);
    p.scaleEdge = rgb(0x7ac0ff);
    p.scaleEdgeAmount = .25f;
    return fish;
}

Fish clownfish(int variant) {
    Fish fish{.species = "Clownfish", .shape = {}, .pattern = {}};
    FishShape& s = fish.shape;
    s.outline = {{0, .075f, .15f, .20f, .22f, .212f, .178f, .122f, .09f},
                 {0, .07f, .138f, .19f, .208f, .204f, .17f, .118f, .086f},
                 {0, .055f, .095f, .125f, .13f, .12f, .09f, .055f, .026f}};
    s.medianFins = {{FinKind::dorsal, .29f, .9f, {.04f, .10f, .075f, .10f, .15f, .04f}, .35f, .9f, .15f, .07f, 20},
                    {FinKind::anal, .58f, .9f, {.03f, .11f, .15f, .14f, .09f, .03f}, .5f, 1.0f, .15f, .05f, 11}};
    s.caudal = {.25f, .55f, .0f, .28f, 18};
    s.pectoral = {FinKind::pectoral, .31f, -.15f, .271f, 1.35f, .65f, .15f, .07f, 15};
    s.pelvic = {FinKind::pelvic, .34f, -.85f, .224f, .55f, .25f, .6f, .03f, 8};
    s.eyeRadius = .036f;
    s.eyeHeight = .32f;
    FishPattern& p = fish.pattern;
    const bool dark = variant % 2 == 1;
    setBody(p, dark ? 0xd83a0c : 0xf26408, dark ? 0xf0520f : 0xff7a0e, dark ? 0xff7a2c : 0xffa040);
    const glm::vec3 white = rgb(0xfaf6ee);
    const glm::vec3 black = rgb(0x10101a);
    p.bands = {{.26f, .036f, .015f, .01f, white, black, .013f},
               {.555f, .045f, -.06f, 0, white, black, .013f},
               {.90f, .022f, 0, 0, white, black, .012f}};
    setMedianFins(p, dark ? 0xe8480e : 0xff7410, 0xff9a30);
    p.medianRim = black;
    p.medianRimWidth = .15f;
    setCaudalFin(p, 0xff7a12, 0xffac48);
    p.caudalRim = black;
    p.caudalRimWidth = .09f;
    setPairedFins(p, 0xff7a14, 0xffa844);
    p.iris = rgb(0xe08a2a);
    p.scaleEdge = rgb(0xffc880);
    p.scaleEdgeAmount = .16f;
    return fish;
}

Fish goldfish(int variant) {
    Fish fish{.species = "Goldfish", .shape = {}, .pattern = {}};
    FishShape& s = fish.shape;
    s.outline = {{0, .08f, .15f, .225f, .26f, .25f, .195f, .125f, .082f},
                 {0, .08f, .145f, .225f, .275f, .27f, .205f, .12f, .078f},
                 {0, .07f, .115f, .16f, .175f, .16f, .115f, .065f, .03f}};
    s.medianFins = {{FinKind::dorsal, .36f, .8f, {.18f, .30f, .27f, .22f, .17f, .10f}, .55f, 1.05f, .35f, .05f, 18},
                    {FinKind::anal, .74f, .92f, {.10f, .20f, .25f, .26f, .22f, .12f}, .7f, 1.2f, .3f, .04f, 9}};
    s.caudal = {.72f, .74f, .5f, .22f, 26};
    s.pectoral = {FinKind::pectoral, .29f, -.45f, .295f, .9f, .7f, .4f, .05f, 12};
    s.pelvic = {FinKind::pelvic, .42f, -.85f, .28f, .7f, .3f, .7f, .04f, 10};
    s.eyeRadius = .04f;
    s.eyeHeight = .3f;
    s.scaleSize = .052f;
    s.finRipple = .055f;
    FishPattern& p = fish.pattern;
    if (variant % 2 == 0) {  // palette: gold
        setBody(p, 0xf25a06, 0xff8412, 0xffc458);
        setMedianFins(p, 0xff7a14, 0xffb45a);
        setCaudalFin(p, 0xff7c16, 0xffc680);
    } else {  // palette: scarlet and pearl
        setBody(p, 0xe0300e, 0xff5a20, 0xfff0dc);
        p.spots = {.34f, .34f, .3f, 1.0f, -1.0f, .7f, rgb(0xfff2e2), {}, 0};
        setMedianFins(p, 0xf04a1c, 0xffe2cc);
        setCaudalFin(p, 0xff6a34, 0xfff0e2);
    }
    setPairedFins(p, 0xff9638, 0xffdcae);
    p.iris = rgb(0xffc23a);
    p.scaleEdge = rgb(0xffe6a0);
    p.scaleEdgeAmount = .42f;
    p.scaleVariation = .1f;
    return fish;
}

}  // namespace defocus::engine::prototypes
