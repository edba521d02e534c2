"""`graphface models`: the 3-D face models at hand, bringing in others, learning one from photographs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from graphface.nodes.morphable.model import MorphableModel

app: typer.Typer = typer.Typer(
    help="List, import, describe, learn, correct or reduce 3-D face models; learn the network that labels.",
    no_args_is_help=True,
)


@app.callback()
def models() -> None:
    """List, import, describe, learn, correct or reduce 3-D face models."""


@app.command("list")
def list_models() -> None:
    """Show the built-in model and those that were imported."""
    from graphface.nodes.morphable.library import library
    from graphface.report.terminal import print_table

    rows = []
    for name, path in library().items():
        model = _loaded(str(path))
        sizes = (f"{len(model.mean)}", f"{len(model.identity)}", f"{len(model.expression)}")
        rows.append((name, *sizes, ", ".join(model.landmarks), str(path)))
    print_table(("model", ">vertices", ">identity", ">expression", "landmarks", "file"), rows)


@app.command()
def info(model: Annotated[str, typer.Argument(help="A model's name, or a file.")] = "builtin") -> None:
    """Describe a model: its size, its prior, what it was made from, what it cannot do."""
    found = _loaded(model)
    print(f"{found.name}: {len(found.mean)} vertices, {len(found.triangles)} triangles")
    print(f"  identity    {len(found.identity)}")
    print(f"  expression  {len(found.expression)}")
    for scheme, vertices in found.landmarks.items():
        print(f"  landmarks   {scheme}, {(vertices >= 0).sum()} of {len(vertices)}")
    prior = found.prior
    print(f"  prior       {'independent normal' if prior is None else f'mixture of {len(prior.weights)} Gaussians'}")
    print(f"  texture     {'yes' if found.uv is not None else 'no'}")
    if found.part_names:
        print(f"  parts       {', '.join(found.part_names)}")
    for key, value in found.card.items():
        print(f"  {key:<11} {value}")


@app.command("import")
def import_model(
    source: Annotated[Path, typer.Argument(help="The model's file or folder, as its makers distribute it.")],
    kind: Annotated[str, typer.Option(help="ict, surrey, flame or basel; guessed by default.")] = "",
    name: Annotated[str, typer.Option(help="What to call it; the kind by default.")] = "",
    landmarks: Annotated[
        Path | None, typer.Option(help='Lines "37 = 2088" (iBUG point = vertex), where the source has none.')
    ] = None,
    out: Annotated[Path | None, typer.Option(help="File to write; the user's model folder by default.")] = None,
) -> None:
    """Bring a model of another format into graphface's."""
    from graphface.nodes.morphable.library import model_folder
    from graphface.nodes.morphable.readers import guess_kind, read_model
    from graphface.nodes.morphable.storage import save_model

    kind = kind or guess_kind(source)
    model = read_model(source, kind, landmarks)
    path = out if out is not None else model_folder() / f"{name or kind}.safetensors"
    save_model(model, path)
    print(f"{path}: {len(model.mean)} vertices, {len(model.identity)} identity, {len(model.expression)} expression")


@app.command()
def learn(
    folder: Annotated[Path, typer.Argument(help="Photographs, one of each person.")],
    people: Annotated[
        Path | None, typer.Option(help="Photographs, several of each person: PERSON_anything.jpg; teach expression.")
    ] = None,
    out: Annotated[Path, typer.Option(help="File to write.")] = Path("learned.safetensors"),
    name: Annotated[str, typer.Option(help="What to call the model.")] = "learned",
    identity: Annotated[int, typer.Option(min=1, help="Identity components.")] = 15,
    expression: Annotated[int, typer.Option(min=0, help="Expression components.")] = 10,
    card: Annotated[Path | None, typer.Option(help="JSON with more for the model's card.")] = None,
) -> None:
    """Learn a model from photographs: the built-in one was made so (see its card)."""
    from graphface.nodes.learning.face_model import learn_from_photos
    from graphface.nodes.morphable.storage import save_model

    expression = expression if people is not None else 0
    model, figures = learn_from_photos(folder, people, name, identity=identity, expression=expression, card=card)
    save_model(model, out, half=True)
    print(
        f"{out}: from {figures.faces} portraits and {figures.photos_of_people} photographs of {figures.people} people; "
        f"leaves {figures.left:.2f} % of the eye distance, {figures.left_unseen:.2f} % on unseen faces; "
        f"prior of {figures.components} Gaussians"
    )


@app.command()
def relief(
    model: Annotated[Path, typer.Argument(help="A model's file, as `models learn` writes it.")],
    data: Annotated[Path, typer.Option(help="Folder of ground truth; it holds truth/.")] = Path("../shared/data"),
    out: Annotated[Path, typer.Option(help="File to write.")] = Path("relief.safetensors"),
) -> None:
    """Correct a learned model's relief by heads whose normals are known: the last step of making the built-in one."""
    from graphface.nodes.learning.relief import relief_of_heads
    from graphface.nodes.morphable.storage import load_model, save_model

    better, off = relief_of_heads(load_model(model, refine=False), data)
    save_model(better, out, half=True)
    print(f"{out}: normals off by " + ", ".join(f"{degrees:.2f} degrees {when}" for when, degrees in off.items()))


@app.command()
def head(
    source: Annotated[Path, typer.Argument(help="ICT-FaceKit: its folder FaceXModel, or packed as .npz.")],
    data: Annotated[Path, typer.Option(help="Folder of ground truth; it holds truth/.")] = Path("../shared/data"),
    out: Annotated[Path, typer.Option(help="File to write.")] = Path("head.safetensors"),
    identity: Annotated[int, typer.Option(min=1, help="Identity components.")] = 10,
    triangles: Annotated[int, typer.Option(min=500, help="Approximate number.")] = 9000,
) -> None:
    """Reduce ICT-FaceKit to the head of render.fitted_head: the shipped one was made so."""
    from graphface.nodes.learning.head_model import head_model
    from graphface.nodes.morphable.storage import save_model

    model = head_model(source, data, identity=identity, triangles=triangles)
    save_model(model, out, half=True)
    print(f"{out}: {len(model.mean)} vertices, {len(model.triangles)} triangles, {len(model.identity)} identity")


@app.command()
def labels(
    photos: Annotated[Path, typer.Argument(help="Varied photographs of faces; MediaPipe's network labels them.")],
    portraits: Annotated[Path | None, typer.Option(help="Photographs that are much alike.")] = None,
    people: Annotated[
        Path | None, typer.Option(help="Photographs, several of each person: PERSON_anything.jpg.")
    ] = None,
    data: Annotated[Path | None, typer.Option(help="Folder of ground truth; it holds truth/.")] = None,
    rendered: Annotated[Path | None, typer.Option(help="Folder that `models render` filled.")] = None,
    only: Annotated[
        list[str] | None, typer.Option(help="Names of PHOTOS to learn from: 'pd_*'; may be repeated.")
    ] = None,
    without: Annotated[
        list[str] | None, typer.Option(help="Names to keep out, to be tested on: 'mk_*', 'gt01_*'; may be repeated.")
    ] = None,
    kept: Annotated[
        Path | None, typer.Option(help="Folder for labelled photographs, which another run need not label again.")
    ] = None,
    out: Annotated[Path, typer.Option(help="File to write.")] = Path("labels.safetensors"),
    steps: Annotated[int | None, typer.Option(min=1, help="Steps of eight pictures; as shipped by default.")] = None,
    card: Annotated[Path | None, typer.Option(help="JSON with more for the model's card.")] = None,
) -> None:
    """Learn the small network of masks.cue; needs PyTorch and graphface[network]. The shipped one was made so.

    Each picture is varied: another frame, light and backdrop, hair of somebody else or dyed, a scarf, paint, bare
    shoulders. --kept holds labelled photographs; a run that was stopped does not label them again.
    """
    from dataclasses import replace

    from graphface.nodes.learning.face_model import read_card
    from graphface.nodes.learning.label_learning import Schedule, Sources, learn_labels
    from graphface.nodes.masks.label_weights import write_weights

    given = read_card(card)
    schedule = Schedule() if steps is None else replace(Schedule(), steps=steps)
    sources = Sources(photos, portraits, people, data, rendered, only or (), without or (), kept)
    weights, made = learn_labels(sources, schedule)
    write_weights(weights, {**given, **made}, out)
    print(f"{out}: from {made['variations']} variations of {made['photographs']} photographs and of truth")


@app.command()
def render(
    out: Annotated[Path, typer.Argument(help="Folder to fill; what is there is not rendered again.")],
    head: Annotated[Path, typer.Option(help="Your copy of ICT-FaceKit (MIT): its folder FaceXModel, or packed.")],
    count: Annotated[int, typer.Option(min=1, help="Number of examples, or of people.")] = 100,
    expressions: Annotated[
        int, typer.Option(min=0, help="Of each person, as NUMBER_EXPRESSION.png for `models learn --people`.")
    ] = 0,
    seed: Annotated[int, typer.Option(min=0, help="Number of the first; each example depends on its number.")] = 0,
    size: Annotated[int, typer.Option(min=16, max=1024, help="Pixels along a side.")] = 176,
    samples: Annotated[int, typer.Option(min=1, help="Paths through a pixel; what is left of noise is filtered.")] = 3,
) -> None:
    """Render heads with everything known about them; needs graphface[truth].

    Each example is a random person (identity, expression, bumps and wrinkles that no model has, skin, make-up, stubble,
    hair), pose, lens, light and camera. NUMBER.npz holds `photo` (sRGB), `normals` (127 times the unit normal in the
    camera frame), `depth` (inter-ocular distances), `labels` (0 rest, 1 skin, 2 eyes and teeth), `visibility`
    (255 times the share of the first lamp that reaches a pixel) and `facts` (JSON: lights, pose, camera).

    With --expressions each person is photographed so many times, near-frontal under even light: smiling, talking,
    frowning, with closed eyes. Only the photographs are kept. --size 256 and more shows the landmark network enough.

    A run that was stopped goes on where it was. One process uses one core: start several, with seeds of their own.
    """
    from graphface.nodes.learning.rendering.folder import render_folder, render_people

    seeds = range(seed, seed + count)
    if expressions:
        found = render_people(head, out, seeds, expressions=expressions, size=size, samples=samples)
        made = sum(new for _, new in found)
        print(f"{out}: {made} photographs of {count} people rendered, {expressions * count - made} were there")
        return
    made = sum(new for _, new in render_folder(head, out, seeds, size=size, samples=samples))
    print(f"{out}: {made} rendered, {count - made} were there")


@app.command()
def normals(
    examples: Annotated[Path, typer.Argument(help="Folder that `models render` filled.")],
    out: Annotated[Path, typer.Option(help="File to write.")] = Path("normals.safetensors"),
    minutes: Annotated[float, typer.Option(min=0, help="Of training, once the examples are read.")] = 20,
    threads: Annotated[int, typer.Option(min=1, help="Of PyTorch.")] = 2,
    card: Annotated[Path | None, typer.Option(help="JSON with more for the model's card.")] = None,
) -> None:
    """Learn the small network of surface.refined from rendered heads; needs graphface[learn]."""
    from graphface.nodes.learning.face_model import read_card
    from graphface.nodes.learning.normal_learning import learn_normals
    from graphface.nodes.network_weights import write_network
    from graphface.nodes.surface.normal_network import NETWORK

    given = read_card(card)
    weights, made = learn_normals(examples, minutes=minutes, threads=threads)
    write_network(weights, {**given, **made}, out, NETWORK)
    off = ", ".join(f"{degrees:.2f} degrees {when}" for when, degrees in made["degrees_off_kept_back"].items())
    print(f"{out}: from {made['examples']} examples; normals of those kept back are off by {off}")


def _loaded(model: str) -> MorphableModel:
    from graphface.nodes.morphable.library import named_model

    return named_model(model)
