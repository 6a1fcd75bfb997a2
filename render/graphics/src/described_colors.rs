//! Colours of PNG files that describe their colours without an ICC profile: by code points (cICP), or by gamma and
//! chromaticities (gAMA, cHRM).
//!
//! PNG Specification, third edition (W3C 2025), section 4.3: cICP comes before iCCP, iCCP before sRGB, and sRGB before
//! gAMA and cHRM.

use std::io::Cursor;

use moxcms::{
    Chromaticity, CicpColorPrimaries, CicpProfile, ColorPrimaries, ColorProfile,
    MatrixCoefficients, ToneReprCurve, TransferCharacteristics,
};
use png::{ColorType, Info};

use crate::picture_formats::PNG_SIGNATURE;

/// Colours of a PNG file without an ICC profile and without the chunk `sRGB`. Its chunks `cICP`, or `gAMA` and
/// `cHRM`, describe them.
#[derive(Debug)]
pub(crate) struct DescribedColors {
    /// Profile that converts the picture.
    pub(crate) profile: ColorProfile,
    /// Whether it comes before an ICC profile in the same file.
    pub(crate) before_icc: bool,
}

impl DescribedColors {
    /// The described colours of the PNG file `bytes`. You get `None` for any other file, for a file that describes
    /// none, and for a file that is damaged, which its decoder refuses.
    ///
    /// # Errors
    /// The reason, if we know the description but cannot convert from it.
    pub(crate) fn of_png(bytes: &[u8]) -> Result<Option<Self>, String> {
        if !bytes.starts_with(PNG_SIGNATURE) {
            return Ok(None);
        }
        let Ok(reader) = png::Decoder::new(Cursor::new(bytes)).read_info() else { return Ok(None) };
        let info = reader.info();
        if let Some(points) = &info.coding_independent_code_points {
            let points =
                [points.color_primaries, points.transfer_function, points.matrix_coefficients];
            let profile = profile_of_code_points(points)?;
            return Ok(Some(Self { profile, before_icc: true }));
        }
        if info.icc_profile.is_some() || info.srgb.is_some() {
            return Ok(None);
        }
        let profile = profile_of_gamma(info);
        Ok(profile.map(|profile| Self { profile, before_icc: false }))
    }
}

/// The profile of primaries, transfer function and matrix of Rec. ITU-T H.273.
fn profile_of_code_points([primaries, transfer, matrix]: [u8; 3]) -> Result<ColorProfile, String> {
    if let Some(name) = [(16, "PQ"), (18, "HLG")].into_iter().find(|(code, _)| *code == transfer) {
        return Err(format!("cICP names {}, light of high dynamic range", name.1));
    }
    let unknown = || format!("cICP names the code points {primaries}, {transfer}, {matrix}");
    let color_primaries = CicpColorPrimaries::try_from(primaries).map_err(|_| unknown())?;
    let transfer_characteristics =
        TransferCharacteristics::try_from(transfer).map_err(|_| unknown())?;
    let is_known = ColorPrimaries::try_from(color_primaries).is_ok()
        && ToneReprCurve::try_from(transfer_characteristics).is_ok();
    // Samples of a PNG file are always RGB.
    if !is_known || matrix != 0 {
        return Err(unknown());
    }
    Ok(ColorProfile::new_from_cicp(CicpProfile {
        color_primaries,
        transfer_characteristics,
        matrix_coefficients: MatrixCoefficients::Identity,
        full_range: true,
    }))
}

/// The profile of the chunks gAMA and cHRM. What one of them leaves open is as in sRGB.
fn profile_of_gamma(info: &Info<'_>) -> Option<ColorProfile> {
    // A sample is light to the power of gAMA.
    let encoding = info.gama_chunk.map(|gamma| gamma.into_value()).filter(|gamma| *gamma > 0.0);
    let curve = encoding.map(|encoding| ToneReprCurve::Parametric(vec![1.0 / encoding]));
    if matches!(info.color_type, ColorType::Grayscale | ColorType::GrayscaleAlpha) {
        let mut profile = ColorProfile::new_gray_with_gamma(1.0);
        profile.gray_trc = Some(curve?);
        return Some(profile);
    }
    let colors = info.chrm_chunk.and_then(|told| {
        let [white, red, green, blue] = [told.white, told.red, told.green, told.blue]
            .map(|(x, y)| Chromaticity::new(x.into_value(), y.into_value()));
        let are_colors = [white, red, green, blue].iter().all(|color| color.y > 0.0);
        let area = (red.x - blue.x) * (green.y - blue.y) - (green.x - blue.x) * (red.y - blue.y);
        (are_colors && area.abs() > 1e-3).then_some((white, ColorPrimaries { red, green, blue }))
    });
    if curve.is_none() && colors.is_none() {
        return None;
    }
    let mut profile = ColorProfile::new_srgb();
    profile.cicp = None;
    if let Some((white, primaries)) = colors {
        profile.update_rgb_colorimetry(white.to_xyyb(), primaries);
    }
    if let Some(curve) = curve {
        profile.red_trc = Some(curve.clone());
        profile.green_trc = Some(curve.clone());
        profile.blue_trc = Some(curve);
    }
    Some(profile)
}

#[cfg(test)]
mod tests {
    use crate::picture::Photograph;
    use png::chunk::ChunkType;
    use spectra::color::Rgb;

    /// A picture of one colour with these chunks before its data.
    fn file(color: png::ColorType, pixel: &[u8], chunks: &[([u8; 4], Vec<u8>)]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 4, 4);
        encoder.set_color(color);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().unwrap();
        for (name, data) in chunks {
            writer.write_chunk(ChunkType(*name), data).unwrap();
        }
        writer.write_image_data(&pixel.repeat(16)).unwrap();
        writer.finish().unwrap();
        bytes
    }

    fn numbers(values: &[u32]) -> Vec<u8> {
        values.iter().flat_map(|value| value.to_be_bytes()).collect()
    }

    fn gamma(value: u32) -> ([u8; 4], Vec<u8>) {
        (*b"gAMA", numbers(&[value]))
    }

    /// Chromaticities of Display P3, times 100,000.
    fn display_p3() -> ([u8; 4], Vec<u8>) {
        (*b"cHRM", numbers(&[31_270, 32_900, 68_000, 32_000, 26_500, 69_000, 15_000, 6_000]))
    }

    fn light(bytes: &[u8]) -> [f32; 3] {
        Photograph::from_bytes("made.png", bytes).unwrap().on_canvas(1, 1)[(0, 0)]
    }

    fn near(found: [f32; 3], wanted: [f64; 3], what: &str) {
        let far = found.iter().zip(wanted).map(|(f, w)| (f64::from(*f) - w).abs());
        assert!(far.fold(0.0, f64::max) < 1e-3, "{what}: {found:?} for {wanted:?}");
    }

    const RGB: [u8; 3] = [180, 120, 60];

    fn shares(power: f64) -> [f64; 3] {
        RGB.map(|value| (f64::from(value) / 255.0).powf(power))
    }

    fn srgb() -> [f64; 3] {
        RGB.map(|value| Rgb([f64::from(value) / 255.0; 3]).linear().0[0])
    }

    #[test]
    fn the_gamma_of_a_file_is_honoured() {
        for (value, power) in [(100_000, 1.0), (55_556, 1.8), (45_455, 2.2), (38_462, 2.6)] {
            let found = light(&file(png::ColorType::Rgb, &RGB, &[gamma(value)]));
            near(found, shares(power), &format!("gAMA {value}"));
            let grey = light(&file(png::ColorType::Grayscale, &[90], &[gamma(value)]));
            near(grey, [(90.0_f64 / 255.0).powf(power); 3], &format!("grey, gAMA {value}"));
        }
        near(light(&file(png::ColorType::Rgb, &RGB, &[])), srgb(), "no chunk");
        near(light(&file(png::ColorType::Rgb, &RGB, &[gamma(0)])), srgb(), "gAMA 0 is void");
    }

    #[test]
    fn chromaticities_of_a_file_are_honoured() {
        let p3 = [
            [1.224_940, -0.224_940, 0.0],
            [-0.042_057, 1.042_057, 0.0],
            [-0.019_638, -0.078_636, 1.098_274],
        ];
        let in_srgb = |light: [f64; 3]| {
            p3.map(|row| row.iter().zip(light).map(|(m, l)| m * l).sum::<f64>().clamp(0.0, 1.0))
        };
        let both = light(&file(png::ColorType::Rgb, &RGB, &[gamma(55_556), display_p3()]));
        near(both, in_srgb(shares(1.8)), "gAMA and cHRM");
        let alone = light(&file(png::ColorType::Rgb, &RGB, &[display_p3()]));
        near(alone, in_srgb(srgb()), "cHRM with the curve of sRGB");
        let void = (*b"cHRM", numbers(&[31_270, 32_900, 1, 1, 1, 1, 1, 1]));
        near(light(&file(png::ColorType::Rgb, &RGB, &[void])), srgb(), "no triangle");
    }

    #[test]
    fn code_points_and_srgb_come_before_gamma() {
        let intent = (*b"sRGB", vec![0]);
        let linear = gamma(100_000);
        let found = light(&file(png::ColorType::Rgb, &RGB, &[intent, linear.clone()]));
        near(found, srgb(), "sRGB before gAMA");
        let p3 = (*b"cICP", vec![12, 13, 0, 1]);
        let found = light(&file(png::ColorType::Rgb, &RGB, &[p3, linear]));
        assert!((f64::from(found[0]) - srgb()[0]).abs() > 0.01, "cICP names Display P3: {found:?}");
        let pq = file(png::ColorType::Rgb, &RGB, &[(*b"cICP", vec![9, 16, 0, 1])]);
        let error = Photograph::from_bytes("hdr.png", &pq).unwrap_err().to_string();
        assert!(error.contains("hdr.png") && error.contains("PQ"), "{error}");
    }
}
