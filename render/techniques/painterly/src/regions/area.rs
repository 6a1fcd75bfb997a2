//! Finds the region that a place of a subject belongs to, and how we paint it.

use glam::Vec2;
use graphics::field::Field;
use graphics::mesh::Mesh;

use super::super::settings::Settings;
use super::{RegionArea, Regions, RegionsError};

/// We mark the regions of a picture in at most this many pixels along its longer side.
const MOST_PX: f32 = 2048.0;

/// How the strokes of a region are painted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Style {
    /// Index of the map.
    pub(crate) map: usize,
    pub(crate) size: f32,
    /// Number of lengths of the map by which strokes move in a loop.
    pub(crate) periods: u32,
    /// How much lighter and darker strokes become in turn.
    pub(crate) twinkle: f32,
    /// Number of changes to lighter and darker in a loop.
    pub(crate) twinkles: u32,
    pub(crate) tones: [f32; 2],
}

/// The regions of a subject. Region 0 is everything that you give no region.
#[derive(Debug, Clone)]
pub(crate) struct RegionMap {
    /// One more than the list of regions: everything else comes first.
    pub(crate) styles: Vec<Style>,
    /// Region of each material.
    of_material: Vec<u16>,
    /// Region of each pixel of a picture.
    of_px: Option<Field<u16>>,
}

impl RegionMap {
    /// Regions of a model. `maps` are the names of maps, the first is for everything else.
    ///
    /// # Errors
    /// [`RegionsError`] for maps and materials that are not there, and for areas, angles and
    /// centres of pictures.
    pub(crate) fn of_mesh(
        regions: &Regions,
        mesh: &Mesh,
        maps: &[&str],
        settings: &Settings,
    ) -> Result<Self, RegionsError> {
        let mut of_material = vec![0; mesh.materials.len()];
        for (region, number) in regions.list.iter().zip(1..) {
            let error = |fault: String, hint: &str| {
                Err(RegionsError::region(&regions.name, &region.name, fault, hint))
            };
            let RegionArea::Material(name) = &region.area else {
                let fault = format!("{} is an area of pictures", region.area.key());
                return error(fault, "name the parts of a model by material = \"NAME\"");
            };
            if region.angle_deg.is_some() || region.around.is_some() {
                let fault = "angle_deg and around are for pictures".to_owned();
                return error(fault, "draw guides on a model");
            }
            let own = mesh.materials.iter().zip(&mut of_material);
            let own = own.filter(|(material, _)| material.name == *name);
            if own.map(|(_, region)| *region = number).count() == 0 {
                let mut names: Vec<&str> =
                    mesh.materials.iter().map(|material| &*material.name).collect();
                names.retain(|name| !name.is_empty());
                names.dedup();
                let hint = match names.is_empty() {
                    true => "the materials of this model have no names".to_owned(),
                    false => format!("materials are {}", names.join(", ")),
                };
                return error(format!("the model has no material `{name}`"), &hint);
            }
        }
        let styles = styles(regions, maps, settings)?;
        Ok(Self { styles, of_material, of_px: None })
    }

    /// Regions of a picture of `size_px`.
    ///
    /// # Errors
    /// [`RegionsError`] for maps that are not there, and for materials.
    pub(crate) fn of_picture(
        regions: &Regions,
        size_px: [u32; 2],
        maps: &[&str],
        settings: &Settings,
    ) -> Result<Self, RegionsError> {
        let styles = styles(regions, maps, settings)?;
        if regions.list.is_empty() {
            return Ok(Self { styles, of_material: vec![0], of_px: None });
        }
        let own = Vec2::from(regions.size_px.unwrap_or(size_px).map(|px| px as f32));
        let scale = (MOST_PX / own.max_element()).min(1.0);
        let [width, height] = (own * scale).round().max(Vec2::ONE).to_array().map(|px| px as usize);
        let mut of_px = Field::filled(width, height, 0);
        for (region, number) in regions.list.iter().zip(1..) {
            let inside: Box<dyn Fn(Vec2) -> bool> = match &region.area {
                RegionArea::Polygon(points) => Box::new(|share| within(points, share * own)),
                RegionArea::Label(color) => match &regions.labels {
                    Some(labels) => Box::new(|share| labels[pixel(labels, share)] == *color),
                    None => Box::new(|_| false),
                },
                RegionArea::Material(_) => {
                    let fault = "material is an area of models".to_owned();
                    let hint = "write polygon = [[0, 0], [640, 0], [640, 200]]";
                    return Err(RegionsError::region(&regions.name, &region.name, fault, hint));
                }
            };
            for y in 0..height {
                for x in 0..width {
                    let middle = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                    if inside(middle / Vec2::new(width as f32, height as f32)) {
                        of_px[(x, y)] = number;
                    }
                }
            }
        }
        Ok(Self { styles, of_material: vec![0], of_px: Some(of_px) })
    }

    /// Number of the region at these texture coordinates of a material.
    pub(crate) fn at(&self, material: u32, share: Vec2) -> u16 {
        match &self.of_px {
            Some(of_px) => of_px[pixel(of_px, share)],
            None => self.of_material.get(material as usize).copied().unwrap_or(0),
        }
    }

    /// Least and greatest size of strokes relative to the settings.
    pub(crate) fn sizes(&self) -> [f32; 2] {
        let sizes = self.styles.iter().map(|style| style.size);
        sizes.fold([f32::INFINITY, 0.0], |[least, most], size| [least.min(size), most.max(size)])
    }
}

/// How everything else and each region is painted.
fn styles(
    regions: &Regions,
    maps: &[&str],
    settings: &Settings,
) -> Result<Vec<Style>, RegionsError> {
    let flow = &settings.flow;
    let twinkles = |seconds: f32| (flow.loop_seconds / seconds).round().max(1.0) as u32;
    let rest = Style {
        map: 0,
        size: 1.0,
        periods: flow.periods,
        twinkle: flow.twinkle,
        twinkles: twinkles(flow.twinkle_seconds),
        tones: [settings.light.darkest, settings.light.lightest],
    };
    let mut styles = vec![rest];
    for region in &regions.list {
        let map = match &region.map {
            None => 0,
            Some(name) => maps.iter().position(|map| map == name).ok_or_else(|| {
                let fault = format!("there is no map `{name}`");
                let hint = format!("maps are {}", maps.join(", "));
                RegionsError::region(&regions.name, &region.name, fault, &hint)
            })?,
        };
        styles.push(Style {
            map,
            size: region.size,
            periods: region.flow.unwrap_or(rest.periods),
            twinkle: region.twinkle.unwrap_or(rest.twinkle),
            twinkles: region.twinkle_seconds.map_or(rest.twinkles, twinkles),
            tones: region.tones.unwrap_or(rest.tones),
        });
    }
    Ok(styles)
}

/// The pixel at a place, 0 to 1 over the width and height.
fn pixel<T>(field: &Field<T>, share: Vec2) -> (usize, usize) {
    [(share.x, field.width()), (share.y, field.height())]
        .map(|(share, count)| {
            ((share.max(0.0) * count as f32) as usize).min(count.saturating_sub(1))
        })
        .into()
}

/// Whether a point lies in a polygon. We use the even-odd rule.
fn within(points: &[[f32; 2]], at: Vec2) -> bool {
    let mut inside = false;
    let mut last = Vec2::from(points[points.len() - 1]);
    for &point in points {
        let point = Vec2::from(point);
        if (point.y > at.y) != (last.y > at.y) {
            let crossing = point.x + (at.y - point.y) / (last.y - point.y) * (last.x - point.x);
            inside ^= at.x < crossing;
        }
        last = point;
    }
    inside
}

#[cfg(test)]
mod tests {
    use graphics::mesh::SampleModel;

    use super::*;
    use crate::regions::Region;

    fn regions(list: Vec<Region>) -> Regions {
        Regions { name: "r".to_owned(), list, ..Regions::default() }
    }

    #[test]
    fn later_regions_lie_over_earlier_ones() {
        let list = [("a", 10.0, 60.0), ("b", 40.0, 90.0)].map(|(name, from, to)| {
            let square = vec![[from, from], [to, from], [to, to], [from, to]];
            Region::new(name, RegionArea::Polygon(square))
        });
        let regions = regions(list.into());
        let map =
            RegionMap::of_picture(&regions, [100, 100], &["m"], &Settings::default()).unwrap();
        let at = |x: f32, y: f32| map.at(0, Vec2::new(x, y));
        assert_eq!([at(0.05, 0.5), at(0.2, 0.2), at(0.5, 0.5), at(0.8, 0.8)], [0, 1, 2, 2]);
        assert_eq!(at(1.0, 1.0), 0);
    }

    #[test]
    fn labels_are_stretched_over_the_picture() {
        let labels = Field::from_values(2, 1, vec![[1, 2, 3], [9; 3]]);
        let list = vec![Region::new("a", RegionArea::Label([1, 2, 3]))];
        let own = Regions { labels: Some(labels), ..regions(list) };
        let map = RegionMap::of_picture(&own, [60, 20], &["m"], &Settings::default()).unwrap();
        assert_eq!([0.1, 0.49, 0.51, 0.9].map(|x| map.at(0, Vec2::new(x, 0.5))), [1, 1, 0, 0]);
    }

    #[test]
    fn materials_are_regions_of_models_by_name() {
        let mesh = SampleModel::Village.mesh(1500);
        let own = |name: &str| {
            let mut region = Region::new("a", RegionArea::Material(name.to_owned()));
            region.map = Some("n".to_owned());
            region
        };
        let settings = Settings::default();
        let of = |region| RegionMap::of_mesh(&regions(vec![region]), &mesh, &["m", "n"], &settings);
        let map = of(own("roof")).unwrap();
        let found: Vec<u16> = (0..9).map(|material| map.at(material, Vec2::ZERO)).collect();
        assert_eq!(found, [0, 0, 0, 0, 1, 1, 0, 0, 0]);
        assert_eq!((map.styles[0].map, map.styles[1].map), (0, 1));
        let error = of(own("door")).unwrap_err().to_string();
        assert!(error.contains("no material `door`"), "{error}");
        let polygon = Region::new("a", RegionArea::Polygon(vec![[0.0; 2]; 3]));
        assert!(of(polygon).unwrap_err().to_string().contains("area of pictures"));
        let error = of(Region { map: Some("x".to_owned()), ..own("roof") }).unwrap_err();
        assert!(error.to_string().contains("no map `x`"), "{error}");
    }

    #[test]
    fn a_loop_has_a_whole_number_of_twinkles() {
        let mut region = Region::new("a", RegionArea::Label([0; 3]));
        (region.twinkle, region.twinkle_seconds) = (Some(0.3), Some(1.5));
        let settings = Settings::default();
        let own = styles(&regions(vec![region]), &["m"], &settings).unwrap();
        assert_eq!((own[0].twinkles, own[1].twinkles, own[1].twinkle), (2, 3, 0.3));
    }
}
