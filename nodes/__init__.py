"""The face operators: one plug-in among others, found through the `graphface.nodes` entry-point group.

`pack` says which module declares which family, so that using one method imports one module.
"""

from graphface import Pack

_MODULES = {
    "image": "encode resize unclipped",
    "landmarks": "facemesh given",
    "geometry": "facemesh morphable average",
    "person": "morphable",
    "surface": "rasterize coordinates visibility",
    "texture": "unwrap project",
    "overlay": "mesh normals depth checkerboard",
    "export": "textured",
    "masks": "face geometric features cue cued_hair hair classify network given_head given_hair given_labels",
    "matting": "none guided closed_form knn",
    "regions": "nine",
    "intrinsic": "intensity retinex multiscale_retinex bilateral log_tv l1_flatten bell2014",
    "albedo": "shadow_color",
    "metrics": "psnr si_psnr ssim ms_ssim dssim si_mse lmse whdr normal_angle light_angle iou landmark_error",
    "representation": "bundle given",
    "sh": "fit render rotate from_environment to_environment ball",
    "detail": "additive multiplicative none split",
    "detail.edit": "bands wrinkles shine",
    "render": "samples shade shadow_maps surroundings spread background head skin specular hair_shine response "
    "composite relit",
    "light": "scene panorama",
    "scatter": "none gaussian screen_space",
    "transfer": "mask paint detail recolored",
    "warp": "mesh resample",
    "flow": "none dis farneback deepflow tvl1",
    "makeup": "features pigment albedo shading rendered exposed keep detail occluders skin loose_hair beard coverage "
    "core boundary",
    "blend": "recombine linear multiband poisson",
}
"""The modules of each family that declare its operators; the family is the folder."""

_TYPES = (
    "Albedo",
    "Camera",
    "Correspondence",
    "Depth",
    "Detail",
    "DetailMap",
    "Direction",
    "Environment",
    "FaceCoordinates",
    "Features",
    "FitRecord",
    "Gain",
    "HeadMasks",
    "Image",
    "Intrinsic",
    "Judgements",
    "Landmarks",
    "Lighting",
    "LightingFit",
    "Mask",
    "Mesh",
    "Normals",
    "Pins",
    "Regions",
    "Representation",
    "Samples",
    "Scene",
    "Segmentation",
    "Shading",
    "Shadows",
    "Surface",
    "Surroundings",
    "Texture",
    "TexturedMesh",
    "Visibility",
)

_FILES = {
    "Albedo": "ALBEDO",
    "Depth": "DEPTH",
    "Detail": "DETAIL",
    "Environment": "ENVIRONMENT",
    "Gain": "GAIN",
    "Image": "IMAGE",
    "Judgements": "JUDGEMENTS",
    "Landmarks": "LANDMARKS",
    "Mask": "MASK",
    "Mesh": "MESH",
    "MorphableModel": "MODEL",
    "Normals": "NORMALS",
    "Pins": "PINS",
    "Representation": "REPRESENTATION",
    "Scene": "SCENE",
    "Shading": "SHADING",
    "Texture": "TEXTURE",
    "TexturedMesh": "TEXTURED_MESH",
}
"""What reads and writes the types that files can hold: constants of `graphface.nodes.io.files`."""

pack: Pack = Pack(
    name="graphface",
    graphs="graphface.graphs",
    assets="graphface.nodes.landmarks.weights:ASSETS graphface.nodes.masks.weights:ASSETS",
    operators={
        family: " ".join(f"graphface.nodes.{family}.{module}" for module in modules.split())
        for family, modules in _MODULES.items()
    },
    types={
        **{name: f"graphface.nodes.types:{name}" for name in _TYPES},
        "LabelWeights": "graphface.nodes.masks.label_weights:LabelWeights",
        "MorphableModel": "graphface.nodes.morphable.model:MorphableModel",
    },
    files={
        **{name: f"graphface.nodes.io.files:{constant}" for name, constant in _FILES.items()},
        "LabelWeights": "graphface.nodes.masks.files:LABEL_WEIGHTS",
    },
    schemas={"scene": "graphface.nodes.types:Scene"},
)
