"""nibabel finds every tissue of our NIfTI files where its voxels are, in its own RAS and in LPS; the affine is the
segmentation's, rounded to the single precision that NIfTI has."""
from exchange import check, check_near, expected, folder, need, numpy

nibabel = need("nibabel")

LPS = numpy.diag([-1.0, -1, 1, 1])
facts = expected()["plain"]
lps_from_voxel = numpy.array(facts["lps_from_voxel"])
farthest = 0
for name in ("plain.nii", "plain.nii.gz"):
    image = nibabel.load(folder() / name)
    check((image.affine == (LPS @ lps_from_voxel).astype(numpy.float32)).all(), f"{name}: {image.affine}")
    check(image.header["sform_code"] == 1 and image.header["qform_code"] == 1, f"{name}: codes of the forms")
    # three numbers of single precision stand for the rotation: 1e-7 of 500 mm
    check_near(image.get_qform(), image.affine, 1e-4, f"{name}: qform")
    check(image.header.get_xyzt_units()[0] == "mm", f"{name}: unit")
    check(image.get_data_dtype() == numpy.uint8, f"{name}: {image.get_data_dtype()}")
    voxels = numpy.asarray(image.dataobj)
    labels = {tissue["label"] for tissue in facts["tissues"]}
    check(set(numpy.unique(voxels)) == labels | {0}, f"{name}: labels")
    for tissue in facts["tissues"]:
        centroid = numpy.argwhere(voxels == tissue["label"]).mean(axis=0)
        check_near(centroid, tissue["centroid_voxel"], 1e-6, f"{name}: {tissue['name']}")
        ras = image.affine @ [*centroid, 1]
        distance = numpy.linalg.norm((LPS @ ras)[:3] - tissue["centroid_lps_mm"])
        check(distance < 1e-4, f"{name}: {tissue['name']} is off by {distance} mm")
        farthest = max(farthest, distance)
print(f"{len(labels)} tissues, off by {farthest:.1e} mm at most")
