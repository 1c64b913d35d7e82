#!/usr/bin/python3
"""Writes docs/theory.md from the comments that the physics headers open with, so that the page and the code cannot part.

    docs/write_theory.py            write the page
    docs/write_theory.py --check    fail if the page is not what the headers say, or if a citation has no reference
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "theory.md"

# Chapters: title, what it is about, sections (title, header).
CHAPTERS = [
    ("Frames and conventions", "SI units and radians inside; a case file carries its unit in every key, and only its reader converts. Waves travel "
     "*towards* their heading, counter-clockwise from +x. A phase is a lag. Forces are named with the body they act on.",
     [("Frames, poses, angles", "sim/spatial/pose.h")]),
    ("Multibody dynamics", "Rigid bodies on joints, in the augmented formulation with Lagrange multipliers, stepped implicitly.",
     [("Equations of motion", "sim/multibody/system.h"), ("Joints", "sim/multibody/joint.h"),
      ("Sprung and driven joints", "sim/multibody/joint_drive.h"), ("What a force element offers", "sim/multibody/force_element.h"),
      ("Stepping in time", "sim/multibody/hht.h"), ("Static equilibrium", "sim/multibody/equilibrium.h"),
      ("Stability of an equilibrium", "sim/multibody/stability.h"), ("Dynamic relaxation", "sim/multibody/relaxation.h"),
      ("Moves in statics", "sim/multibody/drive_path.h"),
      ("Natural modes", "sim/modes.h"), ("Response amplitude operators", "sim/response.h")]),
    ("Seas", "Linear waves over a flat bed or in deep water.",
     [("Spectra and components", "sim/sea/spectrum.h"), ("Elevation, pressure, velocity", "sim/sea/wave_field.h"),
      ("Lengths and speeds over a bed", "sim/sea/dispersion.h"), ("Seas in numbers", "sim/sea/sea_statistics.h"),
      ("A measured elevation", "sim/sea/wave_record.h")]),
    ("Hydrostatics and Froude-Krylov pressure", "The pressure of the undisturbed wave, over the hull as it is wet at the instant.",
     [("Pressure on the instantaneous wetted hull", "sim/hull/hydrostatics.h"), ("A triangle at the surface", "sim/hull/mesh/clipped_panel.h"),
      ("A hull at rest", "sim/hull/immersion.h"), ("The linear force", "sim/hull/linear_froude_krylov.h")]),
    ("Radiation and diffraction", "Linear potential theory about the mean position, at zero speed, in deep water or over a flat bed.",
     [("The force on a hull", "sim/hull/hydrodynamics.h"), ("The heading frame", "sim/hull/heading_frame.h"),
      ("Coefficients", "sim/hull/coefficients/coefficients.h"), ("The panel method", "sim/hull/rankine/panel_method.h"),
      ("Its boundary problem", "sim/hull/rankine/boundary_problem.h"), ("At one frequency", "sim/hull/rankine/frequency_response.h"),
      ("Images in a flat bed", "sim/hull/rankine/bed_images.h"),
      ("The water surface and the beach", "sim/hull/rankine/free_surface.h"), ("One panel", "sim/hull/rankine/flat_panel.h"),
      ("Marched in time", "sim/hull/rankine/panel_march.h"), ("Diffraction forces", "sim/hull/diffraction.h"),
      ("Databases of other programs", "sim/hull/coefficients/database_frame.h"), ("Hulls that part", "sim/hull/parting_hydrodynamics.h"),
      ("Viscous damping", "sim/hull/damping.h"), ("Tables of displacement RAOs", "sim/hull/coefficients/rao_table.h"),
      ("Vessels that move by them", "sim/hull/rao_motion.h")]),
    ("The memory of radiation", "From coefficients over frequency to forces in time.",
     [("Models behind one interface", "sim/hull/radiation/radiation.h"), ("Retardation functions from damping", "sim/hull/radiation/damping_transform.h"),
      ("Convolution", "sim/hull/radiation/radiation_memory.h"), ("Fitting a state space", "sim/hull/radiation/state_space_fit.h"),
      ("Poles and residues", "sim/hull/radiation/pole_residue.h"), ("Passivity", "sim/hull/radiation/passivity.h"),
      ("The state space in time", "sim/hull/radiation/state_space_radiation.h"), ("The panel method marched along", "sim/hull/radiation/radiation_march.h")]),
    ("Lifting gear", "Massless elements that pull, push or rub.",
     [("Lines", "sim/lifting/line.h"), ("The unilateral spring-damper", "sim/lifting/unilateral.h"), ("Wires", "sim/lifting/wire.h"),
      ("Hook block, slings, spreader", "sim/lifting/rigging.h"),
      ("Winch and drive profiles", "sim/lifting/profile.h"), ("The angle of a hanging line", "sim/lifting/plane_angle.h"),
      ("Taglines", "sim/lifting/tagline.h"), ("Contact", "sim/lifting/contact.h"), ("Catenaries", "sim/lifting/catenary.h"),
      ("Moorings", "sim/lifting/mooring.h"), ("Springs to the world", "sim/lifting/restoring.h"), ("Ballast", "sim/lifting/ballast.h")]),
    ("Wind and current", "Fluids that pass the lift, steady or in gusts.",
     [("Mean wind and gusts", "sim/environment/gusts.h"), ("Wind and current at a place", "sim/environment/stream.h"),
      ("Areas of bodies", "sim/environment/flow_area.h"), ("Hulls", "sim/environment/flow_hull.h"),
      ("Coefficients of hulls", "sim/environment/flow_coefficients.h")]),
    ("Derivatives and the search", "How a run changes with its parameters, and what a search by gradients looks at.",
     [("The tangent of a step", "sim/multibody/hht_tangent.h"), ("Kinks of the laws", "sim/multibody/branches.h"),
      ("The tangent of a run", "sim/tangent.h"),
      ("Numbers of a changed run", "results/changed_run.h"), ("Smooth counterparts of metrics", "results/smooth_metrics.h"),
      ("What a solver sees", "problems/search/solver_run.h"), ("The solver called auto", "problems/search/auto_search.h")]),
    ("Fitting to measured runs", "Which parameters of a case explain a measurement, and how well they are known; "
     "[fitting.md](fitting.md) tells it to users.",
     [("Decays", "tuning/decay.h"), ("Records", "tuning/record.h"), ("Units and scales", "tuning/measured_unit.h"),
      ("Where a record began", "tuning/start_state.h"), ("Least squares", "tuning/fit.h"),
      ("Residuals", "tuning/record_unit.h"), ("Segments", "tuning/segments.h"), ("Uncertainty", "tuning/uncertainty.h")]),
    ("Metrics", "What the numbers of a report mean; [summary.md](summary.md) lists them.",
     [("Shared definitions", "results/metrics.h"), ("Lift-off and re-hits", "results/metrics/lift_off.cpp")]),
]

# What the short citations stand for. The key is how the text cites: names up to the year.
REFERENCES = {
    "Allgower & Georg 1990": "E. L. Allgower, K. Georg (1990): Numerical Continuation Methods: An Introduction. Springer.",
    "Blendermann 1994": "W. Blendermann (1994): Parameter identification of wind loads on ships. Journal of Wind Engineering and Industrial Aerodynamics 51, 339-351.",
    "Bock 1983": "H. G. Bock (1983): Recent advances in parameter identification techniques for O.D.E. In: Numerical Treatment of Inverse Problems in Differential and Integral Equations, Birkhäuser, 95-121.",
    "Bruls & Cardona 2010": "O. Brüls, A. Cardona (2010): On the use of Lie group time integrators in multibody dynamics. Journal of Computational and Nonlinear Dynamics 5, 031002.",
    "Bruls & Eberhard 2008": "O. Brüls, P. Eberhard (2008): Sensitivity analysis for dynamic mechanical systems with finite rotations. International Journal for Numerical Methods in Engineering 74, 1897-1927.",
    "Cardona & Geradin 1989": "A. Cardona, M. Géradin (1989): Time integration of the equations of motion in mechanism analysis. Computers & Structures 33, 801-820.",
    "Cha, Nam & Ha 2018": "J.-H. Cha, B. W. Nam, S. Ha (2018): Safety analysis for installation of offshore structure based on proportional-derivative control strategy with multibody system.",
    "Cummins 1962": "W. E. Cummins (1962): The impulse response function and ship motions. Schiffstechnik 9, 101-109.",
    "DNV-RP-C205": "DNV-RP-C205: Environmental conditions and environmental loads.",
    "Faltinsen 1990": "O. M. Faltinsen (1990): Sea Loads on Ships and Offshore Structures. Cambridge University Press.",
    "Fritsch and Carlson 1980": "F. N. Fritsch, R. E. Carlson (1980): Monotone piecewise cubic interpolation. SIAM Journal on Numerical Analysis 17, 238-246.",
    "Day 1965": "A. S. Day (1965): An introduction to dynamic relaxation. The Engineer 219, 218-221.",
    "Deschrijver 2008": "D. Deschrijver, M. Mrozowski, T. Dhaene, D. De Zutter (2008): Macromodeling of multiport systems using a fast implementation of the vector fitting method. IEEE Microwave and Wireless Components Letters 18, 383-385.",
    "Gustavsen 2006": "B. Gustavsen (2006): Improving the pole relocating properties of vector fitting. IEEE Transactions on Power Delivery 21, 1587-1592.",
    "Gustavsen & Semlyen 1999": "B. Gustavsen, A. Semlyen (1999): Rational approximation of frequency domain responses by vector fitting. IEEE Transactions on Power Delivery 14, 1052-1061.",
    "Haskind 1957": "M. D. Haskind (1957): The exciting forces and wetting of ships in waves. Izvestia Akademii Nauk SSSR, Otdelenie Tekhnicheskikh Nauk 7, 65-79.",
    "Hilber, Hughes & Taylor 1977": "H. M. Hilber, T. J. R. Hughes, R. L. Taylor (1977): Improved numerical dissipation for time integration algorithms in structural dynamics. Earthquake Engineering & Structural Dynamics 5, 283-292.",
    "Himeno 1981": "Y. Himeno (1981): Prediction of ship roll damping - state of the art. University of Michigan, Department of Naval Architecture and Marine Engineering, report 239.",
    "Huber 1981": "P. J. Huber (1981): Robust Statistics. Wiley.",
    "Irvine 1981": "H. M. Irvine (1981): Cable Structures. MIT Press.",
    "Jay & Negrut 2007": "L. O. Jay, D. Negrut (2007): Extensions of the HHT-alpha method to differential-algebraic equations in mechanics. Electronic Transactions on Numerical Analysis 26, 190-208.",
    "Jonkman 2007": "J. M. Jonkman (2007): Dynamics modeling and loads analysis of an offshore floating wind turbine. NREL/TP-500-41958.",
    "Kelley & Keyes 1998": "C. T. Kelley, D. E. Keyes (1998): Convergence analysis of pseudo-transient continuation. SIAM Journal on Numerical Analysis 35, 508-523.",
    "Kreisselmeier & Steinhauser 1979": "G. Kreisselmeier, R. Steinhauser (1979): Systematic control design by optimizing a vector performance index. IFAC Symposium on Computer Aided Design of Control Systems, Zürich, 113-117.",
    "Kring 1994": "D. C. Kring (1994): Time domain ship motions by a three-dimensional Rankine panel method. Doctoral thesis, Massachusetts Institute of Technology.",
    "Negrut, Rampalli, Ottarsson & Sajdak 2007": "D. Negrut, R. Rampalli, G. Ottarsson, A. Sajdak (2007): On an implementation of the Hilber-Hughes-Taylor method in the context of index 3 differential-algebraic equations of multibody dynamics. Journal of Computational and Nonlinear Dynamics 2, 73-85.",
    "Newey & West 1987": "W. K. Newey, K. D. West (1987): A simple, positive semi-definite, heteroskedasticity and autocorrelation consistent covariance matrix. Econometrica 55, 703-708.",
    "Kuik 1988": "A. J. Kuik, G. P. van Vledder, L. H. Holthuijsen (1988): A method for the routine analysis of pitch-and-roll buoy wave data. Journal of Physical Oceanography 18, 1020-1034.",
    "Newman 1962": "J. N. Newman (1962): The exciting forces on fixed bodies in waves. Journal of Ship Research 6, 10-17.",
    "Newman 1977": "J. N. Newman (1977): Marine Hydrodynamics. MIT Press.",
    "Newman 1986": "J. N. Newman (1986): Distributions of sources and normal dipoles over a quadrilateral panel. Journal of Engineering Mathematics 20, 113-126.",
    "Ochi 1976": "M. K. Ochi, E. N. Hubble (1976): Six-parameter wave spectra. 15th Conference on Coastal Engineering, Honolulu, 301-328.",
    "Ogilvie 1964": "T. F. Ogilvie (1964): Recent progress toward the understanding and prediction of ship motions. 5th Symposium on Naval Hydrodynamics, Bergen.",
    "Peifer & Timmer 2007": "M. Peifer, J. Timmer (2007): Parameter estimation in ordinary differential equations for biochemical processes using the method of multiple shooting. IET Systems Biology 1, 78-88.",
    "Perez & Fossen 2008": "T. Perez, T. I. Fossen (2008): Time- vs. frequency-domain identification of parametric radiation force models for marine structures at zero speed. Modeling, Identification and Control 29, 1-19.",
    "Saad & Schultz 1986": "Y. Saad, M. H. Schultz (1986): GMRES: a generalized minimal residual algorithm for solving nonsymmetric linear systems. SIAM Journal on Scientific and Statistical Computing 7, 856-869.",
    "Savitzky & Golay 1964": "A. Savitzky, M. J. E. Golay (1964): Smoothing and differentiation of data by simplified least squares procedures. Analytical Chemistry 36, 1627-1639.",
    "Semlyen & Gustavsen 2009": "A. Semlyen, B. Gustavsen (2009): A half-size singularity test matrix for fast and reliable passivity assessment of rational models. IEEE Transactions on Power Delivery 24, 345-351.",
    "Serban & Hindmarsh 2005": "R. Serban, A. C. Hindmarsh (2005): CVODES: the sensitivity-enabled ODE solver in SUNDIALS. ASME International Design Engineering Technical Conferences, DETC2005-85597.",
    "Shabana 2005": "A. A. Shabana (2005): Dynamics of Multibody Systems. 3rd edition, Cambridge University Press.",
    "Steele, Lea & Flood 2014": "G. L. Steele, D. Lea, C. H. Flood (2014): Fast splittable pseudorandom number generators. OOPSLA 2014, 453-472.",
    "Wheeler 1970": "J. D. Wheeler (1970): Method for calculating forces produced by irregular waves. Journal of Petroleum Technology 22, 359-367.",
    "Wilton 1984": "D. R. Wilton, S. M. Rao, A. W. Glisson, D. H. Schaubert, O. M. Al-Bundak, C. M. Butler (1984): Potential integrals for uniform and linear source distributions on polygonal and polyhedral domains. IEEE Transactions on Antennas and Propagation 32, 276-281.",
}


def opening_comment(path):
    lines = []
    for line in (ROOT / path).read_text(encoding="utf-8").splitlines():
        if not line.startswith("//"):
            if lines:
                break
            continue  # includes before the comment
        lines.append(line[2:])
    if not lines:
        sys.exit(f"{path}: opens with no comment")
    return [line[1:] if line.startswith(" ") else line for line in lines]


def anchor(title):
    """The name that a heading gets on a rendered page."""
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


SECTION_OF = {pathlib.PurePath(path).name: title for _, _, sections in CHAPTERS for title, path in sections}


def linked(text):
    """Names of headers that have a section here lead to it."""
    def link(match):
        title = SECTION_OF.get(match[2])
        return f"[{match[2]}](#{anchor(title)})" if title else match[0]

    return re.sub(r"\b((?:\w+/ ?)*)(\w+\.h)\b", link, text)


def escaped(text):
    """Prose in Markdown: what the comment writes as plain text stays plain."""
    text = re.sub(r"([*<|])", r"\\\1", text)
    return re.sub(r"(?<!\w)_|_(?!\w)", r"\\_", text)


def markdown(lines):
    """Indented lines are equations and tables of symbols: set as they stand. The rest is prose."""
    out, block, prose = [], [], []

    def flush_block():
        while block and not block[-1].strip():
            block.pop()
        if block:
            indent = min(len(l) - len(l.lstrip()) for l in block if l.strip())
            out.extend(["```text", *[l[indent:].rstrip() for l in block], "```", ""])
        block.clear()

    def flush_prose():
        if prose:
            out.extend([linked(escaped(" ".join(prose))), ""])
        prose.clear()

    for line, after in zip(lines, lines[1:] + [""]):
        # A term that is explained on its own line and the ones below it.
        hanging = after.startswith("  ") and re.match(r"\w+(  +|: )\S", line)
        if line.startswith("  ") or hanging:
            flush_prose()
            block.append(line)
        elif not line.strip():
            flush_prose()
            if block:
                block.append("")
        else:
            flush_block()
            prose.append(line.strip())
    flush_prose()
    flush_block()
    return out


def page():
    out = ["# Theory", "",
           "*Written by `docs/write_theory.py` from the comments that the sources open with: what stands here is what the code beside it says of itself.*", "",
           "Every section names its file. Equations are set as in the source; *Eq.* with a number and no name is of Cha, Nam & Ha (2018). "
           "How close the results come to other codes and to experiments is in [validation.md](validation.md); how the hull's coefficients are "
           "made and checked in [hydrodynamics.md](hydrodynamics.md).", ""]
    for chapter, about, sections in CHAPTERS:
        out += [f"## {chapter}", "", about, ""]
        for title, path in sections:
            out += [f"### {title}", "", f"[`{path}`](../{path})", ""] + markdown(opening_comment(path))
    out += ["## References", ""] + [f"- {text}" for text in REFERENCES.values()]
    return "\n".join(out) + "\n"


def missing_references(text):
    """Years that are cited within the chapters and that no reference of that first author has."""
    body = text[: text.index("## References")]
    known = {(re.split(r"[ ,&]", key)[0], key[-4:]) for key in REFERENCES}
    cited = set()
    for match in re.finditer(r"([A-Z][a-z]+)(?:[,&]? (?:[A-Z][a-z]+|&|et al\.?|and|ch\. \d+))*,? \(?(1[89]\d\d|20\d\d)\)?", body):
        cited.add((match[1], match[2]))
    authors = {author for author, _ in known}
    return sorted(f"{a} {y}" for a, y in cited if (a, y) not in known and (a in authors or a not in {"Eng", "Math", "Anal", "In"}))


def main():
    text = page()
    missing = missing_references(text)
    if missing:
        sys.exit("docs/write_theory.py: cited without a reference: " + "; ".join(missing))
    if "--check" in sys.argv[1:]:
        if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
            sys.exit("docs/theory.md is not what the headers say; write it again with docs/write_theory.py")
    else:
        PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
