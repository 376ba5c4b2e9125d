"""One concrete, scaled in strength: that of scenes/parts/facet_concrete.prm with all stresses times b = f_c/42.3 MPa, its moduli times b^.3
(EN 1992-1-1 table 3.1) and the fracture energy times b^2/b^.3 (docs/howto/ready_material.md).
"""
STRENGTH = 42.3e6  # Pa, of facet_concrete between dry platens, five packings
BONDS = {"Modulus": ("Pa", 24e9, "a"), "Tensile strength": ("Pa", 3.15e6, "b"), "Shear strength": ("Pa", 6e6, "b"), "Transitional stress": ("Pa", 50e6, "b"),
         "Fracture energy": ("J/m2", 15.5, "energy"), "Compression limits": ("Pa", (29e6, 65e6, 216e6), "b")}


def entries(f_c):
    """Entries of a scene, `f_c` in Pa."""
    b = f_c / STRENGTH
    factor = {"a": b**0.3, "b": b, "energy": b**2 / b**0.3}
    return [f"Bond/{key} = " + ", ".join(f"{value * factor[by]:.6g} {unit}" for value in (values if isinstance(values, tuple) else (values,)))
            for key, (unit, values, by) in BONDS.items()]
